//! Mistakes of users: each is answered in a few lines with cause, place and remedy; nothing is left
//! half-written. All words of the program stand in one golden file.
//!
//! Missions, nets, traces and instances that are broken inside are in `bad_input`, `broken_pnml`
//! and `conform`; what is given to the command of another kind, in `errors`.

use crate::common::{Folder, golden, patrol};
use std::fmt::Write;
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// The mistakes, each with the line of a shell that makes it.
const MISTAKES: [(&str, &str); 41] = [
    ("a picture in place of a net", "cotama check photo.png"),
    ("an archive in place of a mission", "cotama plan nets.zip"),
    ("a text that is no net", "cotama check notes.txt"),
    ("a text that is no mission", "cotama plan notes.txt"),
    ("an empty file in place of a certificate", "cotama verify empty"),
    ("nothing on standard input", "cotama check - < empty"),
    ("a mission in the encoding Latin-1", "cotama plan latin.toml"),
    ("another folder", "cotama run missions/walk.toml"),
    ("a folder in place of a file", "cotama replay ."),
    ("a typing error in the name of a file", "cotama plan wlak.toml"),
    ("in the name of a model", "cotama statespace watchdgo"),
    ("in a command", "cotama simulat door"),
    ("in an option", "cotama run patrol --fautls none"),
    ("in the name of a schema", "cotama schema misson"),
    ("in a property", "cotama check door --property 'AG (Opne -> AF Closed)'"),
    ("in an event", "cotama simulate door Cal"),
    ("in a file of faults", "cotama run walk.toml --faults typo.toml"),
    ("the extension of another format", "cotama export door --output door.sgv"),
    ("an option of another command", "cotama plan patrol --seed 3"),
    ("two missions", "cotama run patrol delivery"),
    ("minutes in place of ms", "cotama run patrol --duration-limit 10min"),
    ("a unit behind a space", "cotama run patrol --duration-limit 10 min"),
    ("Wh in place of mJ", "cotama plan patrol --energy-limit 2.4Wh"),
    ("J in place of mJ in a file", "cotama plan joule.toml"),
    ("a fraction in a file", "cotama plan fraction.toml"),
    ("a unit in a file", "cotama plan metres.toml"),
    ("a negative limit", "cotama plan patrol --energy-limit -5"),
    ("no thread at all", "cotama check door --jobs 0"),
    ("a number beyond every range", "cotama plan huge.toml"),
    ("a family beyond its range", "cotama check philosophers:99999999999999999999"),
    ("two options that exclude each other", "cotama run patrol --no-report --report mine"),
    ("a format of another version", "cotama plan nine.toml"),
    ("the same, read by a program", "cotama plan nine.toml --json"),
    ("an option that is not there, read by a program", "cotama check door --fast --json"),
    ("the properties of another model", "cotama check kanban:2 --properties door.txt"),
    ("the trace of another model", "cotama conform door run.jsonl"),
    ("half of a certificate", "cotama verify half.json"),
    ("a folder as the file to write", "cotama export door --output folder"),
    ("a file below a file", "cotama new mission notes.txt/hall"),
    // No mistakes, but often taken for some.
    (
        "lines that end as on Windows, behind a byte order mark",
        "cotama plan windows.toml | head -1",
    ),
    (
        "a reader who goes away",
        "{ cotama export philosophers:2000 --format dot; echo it ended with $? >&2; } | head -1",
    ),
];

fn folder() -> Folder {
    let folder = Folder::new("mistakes");
    folder.write("photo.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR");
    folder.write("nets.zip", b"PK\x03\x04\x14\0");
    folder.write("notes.txt", "remember the milk\n");
    folder.write("empty", "");
    folder.write("latin.toml", b"format = \"panorama-mission/1\"\nname = \"caf\xe9\"\n");
    folder.write("walk.toml", patrol(&[]));
    folder.write(
        "typo.toml",
        "format = 'panorama-faults/1'\n[[event]]\nx_m = 12\nkind = 'obstacle'\ndelay_ms = 3000\n",
    );
    folder.write("joule.toml", patrol(&[("energy_mj = ", "energy_j = ")]));
    let duration = "duration_ms = 600000";
    folder.write("fraction.toml", patrol(&[(duration, "duration_ms = 600000.5")]));
    folder.write("huge.toml", patrol(&[(duration, "duration_ms = 99999999999999999999")]));
    let path = "path_length_mm = 187000";
    folder.write("metres.toml", patrol(&[(path, "path_length_mm = \"187 m\"")]));
    folder.write("nine.toml", patrol(&[("panorama-mission/1", "panorama-mission/9")]));
    folder.write("windows.toml", format!("\u{feff}{}", patrol(&[]).replace('\n', "\r\n")));
    folder.write("door.txt", "AG !(Closing & Open)\n");
    fs::create_dir(folder.path().join("folder")).unwrap();
    let ask = "cotama check kanban:2 --property deadlock_free --certificate it.json";
    let made = format!("{ask} && head -c 300 it.json > half.json && rm it.json");
    assert_eq!(folder.shell(&made).code, Some(0));
    let run = folder.shell("cotama run delivery --no-report --trace run.jsonl");
    assert_eq!(run.code, Some(0));
    folder
}

/// Returns the answer of the program to a line: standard output, standard error, exit code.
fn said(folder: &Folder, line: &str) -> String {
    let ended = folder.shell(line);
    format!("$ {line}\n{}{}# exit code {}\n", ended.stdout, ended.stderr, ended.code.unwrap())
}

#[test]
fn every_mistake_is_answered_in_a_few_lines() {
    let folder = folder();
    let before = folder.files("");
    let mut all = String::new();
    for (mistake, line) in MISTAKES {
        let said = said(&folder, line);
        // No terminal: neither colours nor a line that is written again and again.
        assert!(!said.contains(['\u{1b}', '\r']) && !said.contains("panicked"), "{said}");
        assert!(said.lines().count() <= 13, "{said}");
        let wanted = if line.contains("| head") { 0 } else { 2 };
        assert!(said.ends_with(&format!("# exit code {wanted}\n")), "{said}");
        writeln!(all, "-- {mistake}\n{said}").unwrap();
    }
    golden("mistakes.txt", &all);
    assert_eq!(folder.files(""), before);
    assert_eq!(folder.files("folder"), [""; 0]);
}

/// A folder in which nothing can be written and a file that cannot be read: not for root, who may
/// do all that.
#[cfg(unix)]
#[test]
fn a_missing_permission_is_reported() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("mistakes_permissions");
    let permit = |name: &str, mode: u32| {
        fs::set_permissions(folder.path().join(name), fs::Permissions::from_mode(mode)).unwrap();
    };
    fs::create_dir(folder.path().join("locked")).unwrap();
    folder.write("secret.toml", patrol(&[]));
    permit("locked", 0o555);
    permit("secret.toml", 0);
    if fs::read(folder.path().join("secret.toml")).is_ok() {
        cotama_golden::skipped("permissions do not bind this user");
    } else {
        let lines = [
            "cotama plan secret.toml",
            "cotama new mission locked/hall",
            "cotama export door --output locked/door.svg",
            "cotama check door --certificate locked/it.json",
            "cotama run patrol --report locked/report",
            "cotama run patrol --no-report --trace locked/run.jsonl",
        ];
        let all: Vec<_> = lines.iter().map(|line| said(&folder, line)).collect();
        golden("mistakes_permissions.txt", &all.join("\n"));
        assert_eq!(folder.files("locked"), [""; 0]);
    }
    permit("locked", 0o755);
}

/// Whether a signal does not reach this process and those that it starts, as an interruption in the
/// background of some shells.
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|it| it.strip_prefix("SigIgn:"));
    let bit = 1 << (signal - 1);
    ignored.is_some_and(|it| u64::from_str_radix(it.trim(), 16).is_ok_and(|it| it & bit != 0))
}

#[cfg(unix)]
#[test]
fn an_interrupted_check_leaves_no_file() {
    use std::os::unix::process::ExitStatusExt;
    if is_ignored(2) {
        cotama_golden::skipped("interruptions do not reach this process");
        return;
    }
    let folder = Folder::new("mistakes_interrupted");
    let line = [
        "check",
        "philosophers:500",
        "--property",
        "AG eat_1 <= 1 & AG eat_2 <= 1",
        "--engine",
        "explicit",
        "--max-seconds",
        "60",
        "--certificate",
        "it.json",
        "--junit",
        "it.xml",
    ];
    let mut child = Command::new(env!("CARGO_BIN_EXE_cotama"))
        .args(line)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The search begins behind the first line.
    let mut first = String::new();
    let mut stdout = BufReader::new(child.stdout.take().unwrap());
    stdout.read_line(&mut first).unwrap();
    assert_eq!(first, "philosophers:500\n");
    sleep(Duration::from_millis(50));
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let ended = child.wait_with_output().unwrap();
    // A shell calls it exit code 130.
    assert_eq!(ended.status.signal(), Some(2), "{ended:?}");
    assert!(ended.stderr.is_empty(), "{ended:?}");
    assert_eq!(stdout.lines().count(), 0);
    assert_eq!(folder.files(""), [""; 0]);
}

#[cfg(unix)]
#[test]
fn an_interrupted_check_in_json_prints_the_decided_properties() {
    use std::os::unix::process::ExitStatusExt;
    let decided = ["true", "false", "true", "false"];
    for (signal, number, count) in [
        ("INT", 2, 2),
        ("TERM", 15, 2),
        ("HUP", 1, 2),
        ("INT", 2, 1),
        ("TERM", 15, 3),
        ("HUP", 1, 4),
    ] {
        if is_ignored(number) {
            cotama_golden::skipped("a signal does not reach this process");
            continue;
        }
        let ended = interrupted_in_json(signal, count);
        assert_eq!(ended.status.signal(), Some(number), "{ended:?}");
        let answer: serde_json::Value = serde_json::from_slice(&ended.stdout).unwrap();
        crate::schemas::validate("check", &answer);
        let verdicts: Vec<_> =
            answer["results"].as_array().unwrap().iter().map(|it| &it["verdict"]).collect();
        assert_eq!(verdicts, decided[..count], "{signal}");
        // Two of three do not look like all.
        assert_eq!(answer["interrupted"]["asked"], count + 1, "{signal}");
    }
}

/// Sends a signal to a check that searches for the answer to the property behind so many others.
#[cfg(unix)]
fn interrupted_in_json(signal: &str, decided: usize) -> std::process::Output {
    let folder = Folder::new(&format!("mistakes_interrupted_json_{signal}_{decided}"));
    let easy = ["eat_1 = 0", "eat_1 > 0", "eat_2 = 0", "eat_2 > 0"];
    let mut line = vec!["check", "philosophers:500", "--initial", "--engine", "explicit"];
    for property in easy[..decided].iter().chain(&["AG eat_1 <= 1 & AG eat_2 <= 1"]) {
        line.extend(["--property", property]);
    }
    line.extend(["--max-seconds", "60", "--certificate", "it.json", "--json"]);
    let child = Command::new(env!("CARGO_BIN_EXE_cotama"))
        .args(line)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while !folder.path().join(format!("it-{decided}.json")).exists() {
        sleep(Duration::from_millis(10));
    }
    sleep(Duration::from_millis(200));
    let kill = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    child.wait_with_output().unwrap()
}
