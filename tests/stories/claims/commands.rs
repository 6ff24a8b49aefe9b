//! What claims name is there: commands, the tests that these choose, files and folders.

use super::page::Claim;
use super::{root, sources};
use std::fs;

/// What of a claim leads nowhere.
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
    wrong
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

/// The folder of a package of the workspace.
fn folder_of(package: &str) -> Result<&str, String> {
    match package {
        "cotama" => Ok("cli"),
        "cotama-robot" => Ok("firmware/robot"),
        _ => package.strip_prefix("cotama-").ok_or_else(|| format!("no package {package}")),
    }
}

#[test]
fn commands_that_lead_nowhere_are_found() {
    for (command, why) in [
        ("cargo test -p cotama-core --test laws", ""),
        ("cargo test -p cotama-core --test lawz", "there is no target lawz"),
        ("cargo test -p cotama-core --lib monitor::testz", "no test and no module `testz`"),
        ("cargo test -p core --lib", "no package core"),
        ("cotama check door", ""),
        ("cotama chequer door", "no such command"),
        ("tests/proofs/chequer.sh", "there is no tests/proofs/chequer.sh"),
    ] {
        assert_eq!(is_there(command).err().unwrap_or_default(), why, "{command}");
    }
}
