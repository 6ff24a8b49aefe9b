//! The help teaches: every example in it runs.

use crate::common::Folder;

pub(crate) const COMMANDS: [&str; 19] = [
    "list",
    "plan",
    "run",
    "allocate",
    "replay",
    "models",
    "export",
    "simulate",
    "check",
    "statespace",
    "verify",
    "conform",
    "fmeca",
    "new",
    "show",
    "table",
    "schema",
    "completions",
    "man",
];

fn examples(help: &str) -> Vec<&str> {
    help.lines().filter_map(|line| line.strip_prefix("  $ ")).collect()
}

#[test]
fn every_example_runs_and_ends_as_it_says() {
    let mut ran = 0;
    for command in [""].into_iter().chain(COMMANDS) {
        let folder = Folder::new(&format!("help_{command}"));
        let arguments: Vec<_> =
            [command, "--help"].into_iter().filter(|it| !it.is_empty()).collect();
        let help = folder.cotama(&arguments);
        assert_eq!(help.code, Some(0));
        let examples = examples(&help.stdout);
        assert!(
            examples.len() >= 2,
            "`cotama {command} --help` has too few examples:\n{}",
            help.stdout
        );
        for example in examples {
            let expected = i32::from(example.contains("exit code 1"));
            let ended = folder.shell(example);
            assert_eq!(ended.code, Some(expected), "{example}: {ended:?}");
            ran += 1;
        }
    }
    assert!(ran > 20);
}

#[test]
fn every_command_is_in_the_help_and_has_a_manual_page() {
    let folder = Folder::new("help_all");
    let help = folder.cotama(&["--help"]).stdout;
    for command in COMMANDS {
        assert!(help.contains(&format!("\n  {command} ")), "{command} is not in\n{help}");
        let page = folder.cotama(&["man", command]);
        assert!(page.code == Some(0) && page.stdout.contains(".SH SYNOPSIS"), "{page:?}");
    }
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = folder.cotama(&["completions", shell]);
        assert!(script.code == Some(0) && script.stdout.contains("allocate"), "{shell}");
    }
}

#[test]
fn names_of_models_and_missions_are_completed() {
    let folder = Folder::new("help_complete");
    let complete = |words: &str| {
        let last = words.split(' ').count();
        let line = format!(
            "bash -c 'source <(cotama completions bash); COMP_WORDS=(cotama {words}); \
             COMP_CWORD={last}; _cotama cotama {} x; echo \"${{COMPREPLY[@]}}\"'",
            words.split(' ').next_back().unwrap()
        );
        folder.shell(&line).stdout
    };
    assert_eq!(complete("check watc"), "watchdog\n");
    assert_eq!(complete("conform deli"), "delivery\n");
    assert_eq!(complete("run pat"), "patrol\n");
    assert_eq!(complete("check nope"), "\n");
}

#[test]
fn the_version_is_that_of_the_package() {
    let version = Folder::new("help_version").cotama(&["--version"]).stdout;
    assert_eq!(version, format!("cotama {}\n", env!("CARGO_PKG_VERSION")));
}
