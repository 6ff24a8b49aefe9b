//! Names and arguments that a terminal would obey: every command, with each of them, on a screen
//! with colours and without, as an error, as JSON and as a file of another tool.

use crate::common::{Ended, Folder, patrol};
use cotama_core::text::marked;
use serde_json::{Value, json};
use std::fs;
use std::process::Command;

/// Parts of a name: codes of colours and titles, C1, marks of direction, line ends, nothing to
/// see. Without `f0rged` at the beginning of a line, none of them has made a line of its own.
const HOSTILE: [&str; 5] = [
    "a\u{1b}[7;5mb\u{1b}]0;t\u{7}c\u{9b}7md\u{85}",
    "a\u{202e}b\u{2066}c\u{61c}d\u{200f}e\u{2028}f0rged\u{2029}",
    "a\nf0rged: b",
    "a\r\u{8}\u{7f}b\u{9d}",
    "a\u{200b}b\u{feff}\u{ad}c\u{200d}d\u{fe0f}\u{e0041}",
];

/// The codes of this program's own styles.
const OWN: [&str; 12] = [
    "\u{1b}[0m",
    "\u{1b}[1m",
    "\u{1b}[2m",
    "\u{1b}[31m",
    "\u{1b}[32m",
    "\u{1b}[33m",
    "\u{1b}[34m",
    "\u{1b}[35m",
    "\u{1b}[36m",
    "\u{1b}[91m",
    "\u{1b}[94m",
    "\u{1b}[4m",
];

/// Asserts that nothing in an answer is obeyed, and no line is forged.
fn harmless(ended: &Ended, what: &str) {
    for text in [&ended.stdout, &ended.stderr] {
        let plain = OWN.iter().fold(text.clone(), |text, code| text.replace(code, ""));
        let plain = plain.replace("\u{1b}[96m", "").replace("\u{1b}[92m", "");
        let seen = marked(&plain).find(|it| it.1 && !matches!(it.0, '\n' | '\t'));
        assert_eq!(seen, None, "{what}: {text:?}");
        let forged = plain.lines().any(|it| it.trim_start().starts_with("f0rged"));
        assert!(!forged, "{what}: {text}");
    }
    assert!(matches!(ended.code, Some(0..=3)), "{what}: {ended:?}");
}

/// Runs a command as it is, with colours, and with an answer in JSON.
fn all_ways(folder: &Folder, arguments: &[&str]) {
    for more in [&[][..], &["--color", "always"], &["--json"]] {
        let arguments = [arguments, more].concat();
        harmless(&folder.cotama(&arguments), &format!("{arguments:?}"));
    }
}

#[test]
fn an_argument_is_shown_and_not_obeyed_whichever_command_refuses_it() {
    let folder = Folder::new("hostile_arguments");
    for name in HOSTILE {
        for command in crate::help::COMMANDS.into_iter().chain(["campaign", "help"]) {
            all_ways(&folder, &[command, name]);
            harmless(&folder.cotama(&[command, &format!("--{name}")]), command);
            harmless(&folder.cotama(&[command, "door", name]), command);
        }
        let toml = format!("{name}.toml");
        for line in [
            &[name][..],
            &["run", "patrol", "--no-report", "--faults", name],
            &["run", "patrol", "--no-report", "--seed", name],
            &["run", "patrol", "--no-report", "--objective", name],
            &["run", "patrol", "--no-report", "--lost", name],
            &["run", "patrol", "--report", &format!("none/{name}")],
            &["run", "patrol", "--no-report", "--trace", &format!("none/{name}")],
            &["plan", "patrol", "--energy-limit", name],
            &["check", "door", "--property", name],
            &["check", "door", "--property", &format!("EF \"{name}\"")],
            &["check", "door", "--properties", name],
            &["check", "door", "--engine", name],
            &["check", name, "--watch"],
            &["check", &format!("door:{name}")],
            &["estimate", "door", "--property", name],
            &["simulate", "door", &format!("{name}@9")],
            &["simulate", "door", &format!("+{name}")],
            &["export", "door", "--output", name],
            &["export", "door", "--output", &format!("none/{name}.svg")],
            &["export", "door", "--format", name],
            &["conform", "door", name],
            &["verify", name],
            &["replay", name, "--mission", &toml],
            &["campaign", "patrol", "--runs", "5", "--require", name],
            &["campaign", "patrol", "--runs", name],
            &["campaign", "merge", name],
            &["fmeca", &toml],
            &["fmeca", "--function", name],
            &["new", "net", name],
            &["new", "mission", &format!("none/{name}")],
            &["new", "net", "it", "--sources", name],
            &["schema", name],
            &["man", name],
        ] {
            let coloured = [line, &["--color", "always"]].concat();
            harmless(&folder.cotama(&coloured), &format!("{coloured:?}"));
        }
    }
    assert_eq!(folder.files(""), [""; 0]);
}

/// Files of every kind whose own names, and the names in them, are hostile.
#[test]
fn a_name_in_a_file_is_shown_and_not_obeyed_by_any_command() {
    let folder = Folder::new("hostile_files");
    for (number, name) in HOSTILE.into_iter().enumerate() {
        // A documentation can have lines.
        let doc = name.replace('\n', " ");
        let arc = |place: &str| json!([{ "place": place, "weight": 1 }]);
        let place = |name: &str, initial: u32| {
            json!({
                "name": name, "doc": doc, "initial": initial, "bound": 1, "role": "state"
            })
        };
        let go = |own: &str, take: &str, give: &str| {
            json!({ "name": own, "doc": doc, "line": 0, "on": name, "take": arc(take),
                "read": [], "give": arc(give), "emits": [name], "within": Value::Null,
                "priority": 0 })
        };
        let other = format!("x{name}");
        let net = json!({ "schema": "cotama/net/1", "name": name, "doc": doc,
            "places": [place(name, 1), place(&other, 0)],
            "events": [{ "name": name, "doc": doc }],
            "outputs": [{ "name": name, "doc": doc }], "ignored": [],
            "transitions": [go(name, name, &other), go(&other, &other, name)],
            "laws": [{ "reachable": other }, { "never_both": [name, other] }] });
        let file = format!("n{number}{name}.json");
        folder.write(&file, net.to_string());
        for format in ["dot", "svg", "mermaid", "pnml", "scxml", "jani", "matrix", "json", "net"] {
            let ended = folder.cotama(&["export", &file, "--format", format]);
            assert_eq!(ended.code, Some(0), "{format}: {ended:?}");
            harmless(&ended, format);
            let net = ["export", &file, "--format", format, "--style", "net"];
            harmless(&folder.cotama(&net), &format!("{format} as a net"));
        }
        for command in ["models", "check", "statespace"] {
            all_ways(&folder, &[command, &file]);
        }
        assert_eq!(folder.cotama(&["simulate", &file, name, name, "+5"]).code, Some(0));
        all_ways(&folder, &["simulate", &file, name, name, "+5"]);
        all_ways(&folder, &["simulate", &file, "nothing"]);
        let quoted = format!("AG !\"{}\"", other.replace('\n', "\\u{a}"));
        all_ways(&folder, &["check", &file, "--property", &quoted]);
        let deadlock = ["check", &file, "--property", "AG !deadlock", "--property", "EF deadlock"];
        all_ways(&folder, &deadlock);
        harmless(&folder.cotama(&["statespace", &file, "--mcc"]), "mcc");
        harmless(&folder.cotama(&["simulate", &file, name, "--trace", "t.jsonl"]), "trace");
        all_ways(&folder, &["conform", &file, "t.jsonl"]);
        let more = ["--sarif", "s", "--junit", "j", "--trace", "h.html", "--certificate", "c.json"];
        let both =
            ["check", file.as_str(), "--property", "AG !deadlock", "--property", "EF deadlock"];
        let ended = folder.cotama(&[&both[..], &more].concat());
        assert_eq!(ended.code, Some(1), "{ended:?}");
        harmless(&ended, "written");
        for written in
            ["s", "j", "h.html", "h-2.html", "h.2.html", "c.json", "c-2.json", "c.2.json"]
        {
            if let Ok(text) = fs::read_to_string(folder.path().join(written)) {
                let seen = marked(&text).find(|it| it.1 && !matches!(it.0, '\n' | '\t'));
                assert_eq!(seen, None, "{written} of {name:?}");
            }
        }
        all_ways(&folder, &["verify", "c.json"]);

        // Errors with an excerpt.
        folder.write(&file, format!("{{ \"schema\": \"cotama/net/1\", \"{name}\": oh"));
        all_ways(&folder, &["check", &file]);
        let faults = format!("f{number}{name}.toml");
        let text = format!("format = \"panorama-faults/1\" # {name}\n\"{name}\" = 1 {name}\n");
        folder.write(&faults, text);
        all_ways(&folder, &["run", "patrol", "--no-report", "--faults", &faults]);
        all_ways(&folder, &["plan", &faults]);

        let written = |text: &str| -> String {
            let codes = text.chars().map(|c| format!("\\U{:08X}", u32::from(c)));
            codes.collect::<Vec<_>>().concat()
        };
        let mission = format!("m{number}{name}.toml");
        let named = format!("name = \"{}\"", written(name));
        folder.write(&mission, patrol(&[("name = \"patrol\"", &named)]));
        for command in ["plan", "table", "show"] {
            let ended = folder.cotama(&[command, &mission]);
            // Line ends and other controls are refused in the name of a mission.
            let taken = if name.chars().any(char::is_control) { 2 } else { 0 };
            assert_eq!(ended.code, Some(taken), "{command}: {ended:?}");
            harmless(&ended, command);
        }
        all_ways(&folder, &["plan", &mission]);
        all_ways(&folder, &["run", &mission, "--report", "r"]);
        all_ways(&folder, &["run", &mission, "--no-report", "--trace", "run.jsonl"]);
        all_ways(&folder, &["replay", "run.jsonl"]);
        all_ways(&folder, &["campaign", &mission, "--runs", "3"]);
        let fmeca = include_str!("../templates/fmeca.toml");
        let title = fmeca.lines().find(|it| it.starts_with("title = ")).unwrap();
        folder
            .write("it.toml", fmeca.replacen(title, &format!("title = \"{}\"", written(name)), 1));
        all_ways(&folder, &["fmeca", "it.toml"]);
        for format in ["md", "csv", "html", "svg"] {
            harmless(&folder.cotama(&["fmeca", "it.toml", "--format", format]), format);
        }
        folder.write("team.json", json!({ "name": name, name: 1 }).to_string());
        all_ways(&folder, &["assign", "team.json"]);
        all_ways(&folder, &["allocate", "team.json"]);
    }
}

/// A mission whose name turns the text around is a table that the compiler takes.
#[test]
fn a_table_of_a_hostile_name_compiles() {
    let folder = Folder::new("hostile_table");
    for (number, name) in ["\\u202E", "\\u2066", "\\u200F", "\\u061C", "\\u2028"].iter().enumerate()
    {
        let named = format!("name = \"a{name}b\"");
        folder.write("it.toml", patrol(&[("name = \"patrol\"", &named)]));
        let table = folder.cotama(&["table", "it.toml"]);
        assert_eq!(table.code, Some(0), "{table:?}");
        // Comments and texts alone: the rest needs the crates.
        let text: Vec<_> = table.stdout.lines().filter(|it| it.contains("//!")).collect();
        folder.write("it.rs", text.join("\n") + "\nfn main() {}\n");
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let output = Command::new(rustc)
            .args(["--emit=metadata", "--edition=2024", "-o", &format!("{number}.rmeta"), "it.rs"])
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(marked(&table.stdout).all(|it| !it.1 || it.0 == '\n'), "{name}");
    }
}

/// Names of places that would print a line of the contest of their own.
#[test]
fn a_line_of_the_contest_holds_one_word_for_each_name() {
    let folder = Folder::new("hostile_mcc");
    for name in [
        "a\nFORMULA forged TRUE TECHNIQUES EXPLICIT",
        "b TRUE TECHNIQUES",
        "c\u{2028}FORMULA d FALSE",
        "e\tTRUE",
        "f\r\nFORMULA g TRUE",
        "h\u{a0}i",
    ] {
        let net = json!({ "schema": "cotama/net/1", "name": "it", "doc": "",
            "places": [{ "name": name, "doc": "", "initial": 1, "bound": 1, "role": "state" }],
            "events": [], "outputs": [], "ignored": [], "transitions": [],
            "laws": [{ "reachable": name }] });
        folder.write("it.json", net.to_string());
        let ended = folder.cotama(&["check", "it.json", "--mcc"]);
        let lines: Vec<_> = ended.stdout.lines().collect();
        assert!(!lines.is_empty(), "{ended:?}");
        for line in lines {
            let words: Vec<_> = line.split(' ').collect();
            assert_eq!((words[0], words[2], words[3]), ("FORMULA", "TRUE", "TECHNIQUES"), "{line}");
            assert!(marked(line).all(|it| !it.1), "{line}");
        }
    }
}

#[test]
#[cfg(unix)]
fn an_argument_that_is_no_utf_8_is_refused_before_anything_is_written() {
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new("hostile_bytes");
    let name = |end: &str| [b"caf\xe9", end.as_bytes()].concat();
    for (before, end) in [
        (&["run", "patrol", "--report"][..], ""),
        (&["run", "patrol", "--no-report", "--trace"], ".jsonl"),
        (&["export", "door", "--output"], ".svg"),
        (&["check", "door", "--sarif"], ""),
        (&["check", "door", "--certificate"], ".json"),
        (&["campaign", "patrol", "--runs", "5", "--out"], ""),
        (&["fmeca", "--output"], ".html"),
        (&["new", "net"], ""),
        (&["plan"], ".toml"),
    ] {
        let bytes = name(end);
        let output = Command::new(env!("CARGO_BIN_EXE_cotama"))
            .args(before)
            .arg(std::ffi::OsStr::from_bytes(&bytes))
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{before:?}");
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains("no text in UTF-8"), "{before:?}: {said}");
        assert_eq!(folder.files(""), [""; 0], "{before:?}");
    }
}
