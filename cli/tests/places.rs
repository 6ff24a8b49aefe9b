//! Files that are written: where they go, who may read them, and what a full device does.

use crate::common::Folder;

#[test]
#[cfg(unix)]
fn a_symbolic_link_is_followed_and_stays_a_link() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("places_links");
    std::fs::create_dir(folder.path().join("kept")).unwrap();
    folder.write("kept/old.svg", "old");
    symlink("kept/old.svg", folder.path().join("to_old.svg")).unwrap();
    symlink("to_old.svg", folder.path().join("to_link.svg")).unwrap();
    symlink("kept/new.svg", folder.path().join("to_new.svg")).unwrap();
    symlink("kept", folder.path().join("to_folder")).unwrap();
    symlink("round.svg", folder.path().join("round.svg")).unwrap();
    symlink("none/it.svg", folder.path().join("to_none.svg")).unwrap();
    for (output, file) in [
        ("to_old.svg", "kept/old.svg"),
        ("to_link.svg", "kept/old.svg"),
        ("to_new.svg", "kept/new.svg"),
        ("to_folder/more.svg", "kept/more.svg"),
    ] {
        folder.write("kept/old.svg", "old");
        let ended = folder.cotama(&["export", "door", "--output", output]);
        assert_eq!(ended.code, Some(0), "{output}: {ended:?}");
        assert!(folder.read(file).starts_with("<svg"), "{output}");
        let link = folder.path().join(output).symlink_metadata().unwrap();
        assert_eq!(link.is_symlink(), !output.contains('/'), "{output}");
    }
    for (output, says) in [
        ("round.svg", "this symbolic link leads to links without end"),
        ("to_none.svg", "there is no such folder"),
    ] {
        let ended = folder.cotama(&["export", "door", "--output", output]);
        assert!(ended.code == Some(2) && ended.stderr.contains(says), "{output}: {ended:?}");
    }
    assert_eq!(folder.files("kept"), ["more.svg", "new.svg", "old.svg"]);
}

#[test]
#[cfg(unix)]
fn a_file_keeps_its_mode_when_it_is_replaced() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("places_modes");
    for mode in [0o600, 0o640, 0o644, 0o664, 0o700] {
        folder.write("it.svg", "old");
        let path = folder.path().join("it.svg");
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(mode)).unwrap();
        assert_eq!(folder.cotama(&["export", "door", "--output", "it.svg"]).code, Some(0));
        assert_eq!(path.metadata().unwrap().permissions().mode() & 0o777, mode);
        assert!(folder.read("it.svg").starts_with("<svg"));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn an_answer_that_cannot_be_written_ends_with_2() {
    let folder = Folder::new("places_full");
    for line in [
        "--help",
        "--version",
        "help run",
        "check --help",
        "list",
        "list --json",
        "show patrol",
        "table patrol",
        "schema check",
        "man",
        "completions bash",
        "export door --format dot",
        "statespace door",
        "plan patrol",
    ] {
        let ended = folder.shell(&format!("cotama {line} > /dev/full"));
        assert_eq!(ended.code, Some(2), "{line}: {ended:?}");
        assert!(ended.stderr.contains("standard output cannot be written"), "{line}: {ended:?}");
    }
}

/// Explores a time net in a memory that the system limits to little more.
#[test]
#[cfg(target_os = "linux")]
fn state_classes_keep_within_their_memory() {
    let folder = Folder::new("places_memory");
    // Many clocks that start and end at different times: classes without end in sight.
    let net = |number: u32| -> String {
        (0..number)
            .map(|it| {
                let (least, most) = (3 + 2 * it, 11 + 5 * it);
                format!(
                    "tr a{it} [{least},{most}] p{it} -> q{it}\ntr b{it} [1,{most}] q{it} -> \
                    p{it}\npl p{it} (1)\n"
                )
            })
            .collect::<Vec<_>>()
            .concat()
    };
    folder.write("six.net", net(6));
    folder.write("nine.net", net(9));
    for (line, mib) in [
        ("statespace six.net", 200),
        ("check six.net --property 'A (G F q0)'", 160),
        ("check six.net --property 'AG EF q0'", 160),
        ("check six.net --property 'AF (q0 & q1 & q2)'", 100),
        ("statespace nine.net", 120),
        ("statespace six.net", 64),
    ] {
        // The program itself takes less than 24 MiB of addresses, and a list of less than 32 MiB is
        // copied when it grows.
        let most = (mib * 110 / 100 + 24 + 32) << 10;
        let line = format!("ulimit -v {most}; cotama {line} --max-memory {mib} --jobs 1 --json");
        let ended = folder.shell(&line);
        assert_eq!(ended.code, Some(3), "{line}: {ended:?}");
        assert!(ended.stdout.contains("memory"), "{line}: {ended:?}");
    }
}
