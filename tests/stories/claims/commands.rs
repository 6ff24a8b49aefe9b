//! Existence of the things that claims name: commands, the tests that these choose, files and
//! folders, and in these the numbers of the claim.

use super::page::Claim;
use super::{root, sources};
use std::fs;

/// Returns the names of a claim that lead nowhere.
pub(super) fn defects(claim: &Claim) -> Vec<String> {
    let mut wrong = Vec::new();
    for command in &claim.run {
        if let Err(why) = is_there(command) {
            wrong.push(format!("{}: `{command}`: {why}", claim.id));
        }
    }
    for place in claim.places.iter().flat_map(|it| spread(it)) {
        if !root().join(&place).exists() {
            wrong.push(format!("{}: there is no {place}", claim.id));
        }
    }
    let mut text = String::new();
    for place in claim.places.iter().flat_map(|it| spread(it)) {
        sources(&root().join(place), &mut text);
    }
    for number in numbers(&claim.words()).filter(|it| it.len() > 2 && !stands_in(&text, it)) {
        wrong.push(format!("{}: {number} stands in none of the files that it names", claim.id));
    }
    wrong
}

/// The whole numbers of a claim, without the commas of their thousands; those with a point, and
/// powers, are none.
fn numbers(text: &str) -> impl Iterator<Item = String> {
    let words = text.split(|it: char| !it.is_ascii_alphanumeric() && !"_,.^{}".contains(it));
    words.map(|it| it.trim_matches(['.', ',']).replace(',', "")).filter(|it| {
        let is_digit = |it: u8| it.is_ascii_digit();
        !it.is_empty() && it.bytes().all(is_digit)
    })
}

/// Whether the number is in the text, however its thousands are divided there.
fn stands_in(text: &str, number: &str) -> bool {
    let divided = |by: &str| {
        let parts = number.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
        parts.collect::<Vec<_>>().join(by)
    };
    let is_alone = |(at, form): (usize, &str)| {
        let digit = |it: Option<char>| it.is_some_and(|it| it.is_ascii_digit());
        !digit(text[..at].chars().next_back()) && !digit(text[at + form.len()..].chars().next())
    };
    ["", "_", ","].iter().any(|by| text.match_indices(&divided(by)).any(is_alone))
}

/// `a/{b,c}` are two paths.
fn spread(place: &str) -> Vec<String> {
    let parts = place.split_once('{').and_then(|(before, rest)| {
        let (parts, behind) = rest.split_once('}')?;
        Some(parts.split(',').map(|it| format!("{before}{it}{behind}")).collect())
    });
    parts.unwrap_or_else(|| vec![place.to_owned()])
}

/// Whether the first word can be run, and a test that is chosen by name is written somewhere.
fn is_there(command: &str) -> Result<(), String> {
    let words = command.split(' ').skip_while(|it| it.starts_with("PATH="));
    let words: Vec<_> = words.collect();
    match words[..] {
        ["cargo", "test", ref rest @ ..] => is_tested(rest),
        ["cargo", "run" | "bench" | "clippy", ..] => Ok(()),
        ["cotama", name, ..] => {
            let known = fs::read_to_string(root().join("docs/commands.md")).expect("the commands");
            let is_known = known.contains(&format!("cotama {name}"));
            is_known.then_some(()).ok_or_else(|| "no such command".into())
        }
        ["python" | "python3", script, ..] | [script, ..] => {
            let is_file = root().join(script).is_file();
            is_file.then_some(()).ok_or_else(|| format!("there is no {script}"))
        }
        [] => Err("no command".into()),
    }
}

/// `cargo test` with a package, a target and the name of a test or of a module of tests.
fn is_tested(words: &[&str]) -> Result<(), String> {
    let (mut folder, mut target, mut name) = (None, None, None);
    let mut words = words.iter().take_while(|it| **it != "--");
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} of what?"));
        match *word {
            "-p" => folder = Some(folder_of(value()?)?),
            "--test" => target = Some(*value()?),
            "--target" | "--manifest-path" | "--features" => drop(value()?),
            "--lib" => target = Some("lib"),
            "--release" | "--tests" | "--workspace" => {}
            flag if flag.starts_with('-') => return Err(format!("{flag}?")),
            test => name = Some(test),
        }
    }
    let (Some(folder), Some(target)) = (folder, target) else { return Ok(()) };
    let folder = root().join(folder);
    let own = folder.join(target);
    let roots = match target {
        "lib" => vec![folder.join("src")],
        // A crate of tests has its targets at its root.
        _ if own.is_dir() => vec![own],
        _ => vec![folder.join("tests")],
    };
    let is_target = target == "lib"
        || roots[0].ends_with(target)
        || fs::read_to_string(folder.join("Cargo.toml"))
            .is_ok_and(|it| it.contains(&format!("name = \"{target}\"")))
        || folder.join(format!("tests/{target}.rs")).exists()
        || folder.join(format!("tests/{target}/main.rs")).exists();
    if !is_target {
        return Err(format!("there is no target {target}"));
    }
    let mut text = String::new();
    roots.iter().for_each(|it| sources(it, &mut text));
    for part in name.into_iter().flat_map(|it| it.split("::")).filter(|it| !it.is_empty()) {
        let is_written = ["mod ", "fn "].iter().any(|it| text.contains(&format!("{it}{part}")));
        if !is_written && !text.contains(&format!("_{part}")) {
            return Err(format!("no test and no module `{part}`"));
        }
    }
    Ok(())
}

/// The folder of a package of the workspace; one for a purpose stands in that of its face.
fn folder_of(package: &str) -> Result<String, String> {
    let name = match package {
        "cotama" => "cli",
        "robot" => "firmware/robot",
        _ => package.strip_prefix("cotama-").ok_or_else(|| format!("no package {package}"))?,
    };
    let faces = ["", "core/", "models/", "verification/", "sim/"];
    let mut folders = faces.iter().map(|it| format!("{it}{name}"));
    let found = folders.find(|it| root().join(it).join("Cargo.toml").is_file());
    found.ok_or_else(|| format!("no package {package}"))
}

#[test]
fn numbers_are_found_however_their_thousands_are_divided() {
    let read: Vec<_> = numbers("20,000 of 1,234, 10^6; {a.b} 3.5, in 2.").collect();
    assert_eq!(read, ["20000", "1234", "2"]);
    for text in ["0..20_000 {", "20000u32", "of 20,000.", "(1, 20_000)"] {
        assert!(stands_in(text, "20000"), "{text}");
    }
    assert!(!stands_in("120_000", "20000") && !stands_in("20_0001", "20000"));
}

#[test]
fn commands_that_lead_nowhere_are_found() {
    for (command, why) in [
        ("cargo test -p cotama-nets --test laws", ""),
        ("cargo test -p cotama-nets --test lawz", "there is no target lawz"),
        ("cargo test -p cotama-allocation --lib monitor::testz", "no test and no module `testz`"),
        ("cargo test -p core --lib", "no package core"),
        ("cargo test -p cotama-lawz --lib", "no package cotama-lawz"),
        ("cotama check door", ""),
        ("cotama chequer door", "no such command"),
        ("tests/evidence/proofs/chequer.sh", "there is no tests/evidence/proofs/chequer.sh"),
    ] {
        assert_eq!(is_there(command).err().unwrap_or_default(), why, "{command}");
    }
}
