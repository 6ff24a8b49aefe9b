//! The help teaches: every example in it runs.

use crate::common::Folder;

pub(crate) const COMMANDS: [&str; 22] = [
    "list",
    "plan",
    "run",
    "allocate",
    "assign",
    "replay",
    "models",
    "export",
    "simulate",
    "play",
    "check",
    "statespace",
    "estimate",
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

/// The examples of a help text, each with the lines in which it goes on, and a comment.
pub(crate) fn examples(help: &str) -> Vec<String> {
    let mut examples: Vec<String> = Vec::new();
    let mut goes_on = false;
    for line in help.lines() {
        let first = line.strip_prefix("  $ ");
        match (first, examples.last_mut()) {
            (Some(first), _) => examples.push(first.to_owned()),
            (None, Some(example)) if goes_on && line.starts_with("      ") => {
                *example += "\n";
                *example += line;
            }
            _ => {}
        }
        goes_on = first.is_some() || goes_on && line.starts_with("      ");
    }
    examples
}

#[test]
fn every_example_runs_and_ends_as_it_says() {
    assert!(examples_run(100, |example| !is_long(example)) > 20);
}

#[test]
fn examples_that_go_on_in_another_line_run_too() {
    assert!(examples_run(60, |example| !example.contains("delivery")) > 20);
}

#[test]
#[ignore = "minutes: run by hand, or in CI with COTAMA_LONG=all"]
fn examples_with_a_long_search_run_too() {
    assert_eq!(examples_run(100, is_long), 4);
}

/// Whether all states of the delivery robot are searched, or hundreds of its missions are run.
fn is_long(example: &str) -> bool {
    let parts = ["check delivery", "statespace delivery", "--measure delivery --output"];
    parts.iter().any(|it| example.contains(it))
}

/// Runs the chosen examples in a window of this width; how many it were.
fn examples_run(width: usize, chosen: impl Fn(&str) -> bool) -> usize {
    let mut ran = 0;
    for command in [""].into_iter().chain(COMMANDS) {
        let folder = Folder::new(&format!("help_{width}_{command}"));
        let help = folder.shell(&format!("COLUMNS={width} cotama {command} --help"));
        assert_eq!(help.code, Some(0));
        let examples = examples(&help.stdout);
        assert!(
            examples.len() >= 2,
            "`cotama {command} --help` has too few examples:\n{}",
            help.stdout
        );
        for example in examples.iter().filter(|it| chosen(it)) {
            let expected = i32::from(example.contains("exit code 1"));
            let ended = folder.shell(example);
            assert_eq!(ended.code, Some(expected), "{example}: {ended:?}");
            ran += 1;
        }
    }
    ran
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
    assert_eq!(complete("conform cross"), "crossing\n");
    assert_eq!(complete("run pat"), "patrol\n");
    assert_eq!(complete("plan pat"), "patrol patrol-axes\n");
    assert_eq!(complete("explain pat"), "patrol-axes\n");
    assert_eq!(complete("check nope"), "\n");
}

#[test]
fn the_version_is_that_of_the_package() {
    let version = Folder::new("help_version").cotama(&["--version"]).stdout;
    assert_eq!(version, format!("cotama {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn no_line_of_help_is_wider_than_the_screen() {
    let folder = Folder::new("help_width");
    for command in [""].into_iter().chain(COMMANDS) {
        for (width, least) in [(60, 0), (80, 0), (100, 0), (300, 90)] {
            for help in ["--help", "-h"] {
                let line = format!("COLUMNS={width} cotama {command} {help}");
                let said = folder.shell(&line).stdout;
                let widest = said.lines().map(|line| line.chars().count()).max().unwrap();
                let most = width.min(100);
                assert!(widest <= most, "{line}: {widest} > {most}:\n{said}");
                let is_long = command == "check" && help == "--help";
                assert!(!is_long || widest >= least, "{line}: {widest}");
            }
        }
    }
    let page = folder.shell("COLUMNS=60 cotama check --help").stdout;
    // Paragraphs fill their lines: no ragged rest of a longer line.
    assert!(page.contains("\nwithout a name; lines that begin with # are left out. A\n"), "{page}");
}

#[test]
fn help_offers_existing_names_and_general_options_last() {
    let folder = Folder::new("help_offers");
    for command in COMMANDS {
        let help = folder.cotama(&[command, "--help"]).stdout;
        for absent in ["symbolic", "- sat", " sat,", "this version"] {
            assert!(!help.contains(absent), "{command}: {absent}\n{help}");
        }
        let options = help.split("Options:").nth(1).unwrap();
        let color = options.find("--color").unwrap();
        let names = ["--json", "--objective", "--property", "--format", "--strict", "--seed"];
        let later = names.iter().find(|it| options.rfind(&format!("      {it}")) > Some(color));
        assert_eq!(later, None, "{command}\n{help}");
    }
    assert!(folder.cotama(&["plan", "--help"]).stdout.contains("--energy-limit <mJ>"));
}
