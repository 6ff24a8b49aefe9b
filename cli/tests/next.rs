//! Every command that the program prints is run in the state in which it is printed: by `next:`, in
//! a note or a help of an error, and on a page.

use crate::common::{Folder, patrol};
use std::collections::BTreeSet;
use std::path::Path;

/// Returns whether a printed command cannot be run as it is: it names what the user chooses.
fn is_form(command: &str) -> bool {
    let placeholder = |word: &str| {
        let word = word.trim_matches(|c: char| !c.is_ascii_alphanumeric());
        word.len() > 1 && word.chars().all(|c| c.is_ascii_uppercase())
    };
    command.split(' ').any(|word| word.split(['.', '=']).any(placeholder)) || command.contains('…')
}

/// The commands in what is printed: after `next:`, between backticks, and in the code of pages.
fn commands(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for line in text.lines() {
        if let Some(next) = line.strip_prefix("next: ") {
            // Several stand behind each other, each with the name of the program.
            let parts = next.replace(", cotama ", "\ncotama ");
            found.extend(parts.lines().map(str::to_owned));
        }
    }
    let plain = text.replace("&#39;", "'").replace("&quot;", "\"").replace("&amp;", "&");
    let joined = plain.split_whitespace().collect::<Vec<_>>().join(" ");
    for (open, close) in [("`cotama ", '`'), ("<code>cotama ", '<')] {
        for (at, _) in joined.match_indices(open) {
            let rest = &joined[at + open.len() - "cotama ".len()..];
            found.push(rest.split(close).next().unwrap().trim().to_owned());
        }
    }
    // Two words name a command, and do not say of what.
    let named = |it: &str| !it.contains("&&") && it.split(' ').count() == 2;
    let alone = ["cotama models", "cotama list", "cotama fmeca", "cotama help"];
    found.retain(|it| !named(it) || alone.contains(&it.as_str()));
    found.retain(|it| !is_form(it));
    found
}

/// Returns the texts of all pages in a folder.
fn pages(folder: &Path) -> String {
    let mut text = String::new();
    for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let path = entry.path();
        if path.is_dir() {
            text += &pages(&path);
        } else if path.extension().is_some_and(|it| it == "html") {
            text += &std::fs::read_to_string(path).unwrap();
        }
    }
    text
}

/// Runs a command and what it suggests, and what that suggests; how many there were.
fn follow(folder: &Folder, line: &str, seen: &mut BTreeSet<String>, depth: usize) -> usize {
    let ended = folder.shell(&format!("{line} 2>&1"));
    let mut found = commands(&ended.stdout);
    found.extend(commands(&pages(folder.path())));
    let mut count = 0;
    for command in found {
        if !seen.insert(command.clone()) {
            continue;
        }
        // The page of a run says so, and with which option the run writes it.
        if command == "cotama replay run.jsonl" && !folder.path().join("run.jsonl").exists() {
            let runs = |it: &&str| it.starts_with("cotama run ") && !it.contains("--no-report");
            let run = std::iter::once(line).chain(seen.iter().map(String::as_str)).find(runs);
            folder.shell(&format!("{} --trace run.jsonl", run.unwrap()));
        }
        let ended = folder.shell(&command);
        assert!(matches!(ended.code, Some(0 | 1 | 3)), "after `{line}`: `{command}`: {ended:?}");
        assert!(!ended.stderr.contains("error:"), "after `{line}`: `{command}`: {ended:?}");
        count += 1;
        if depth > 0 {
            count += follow(folder, &command, seen, depth - 1);
        }
    }
    count
}

const ROBOT: &str = "net robot\ntr go [1,2] idle -> busy\ntr back busy -> idle\npl idle (1)\n";
/// Bounds that no net of milliseconds can have.
const OPEN: &str = "net open\ntr go ]1,2[ idle -> busy\npl idle (1)\n";
const CYCLE: &str = "net cycle\ntr go idle -> busy\ntr back busy -> idle\npl idle (1)\n";

#[test]
fn every_command_that_is_printed_runs_where_it_is_printed() {
    let mut all = 0;
    for (number, line) in [
        "cotama list",
        "cotama models",
        "cotama models door",
        "cotama models philosophers",
        "cotama models delivery",
        "cotama models robot.net",
        "cotama models open.net",
        "cotama models 'my cycle.net'",
        "cotama models dor",
        "cotama plan patrol",
        "cotama plan patroll",
        "cotama plan 'my walk.toml'",
        "cotama plan patrol --energy-limit 4000000",
        "cotama plan patrol --objective front",
        "cotama run patrol",
        "cotama run 'my walk.toml' --faults none --report r",
        "cotama run hall.toml",
        "cotama run slow.toml --no-report",
        "cotama run slow.toml --faults blocked.toml --no-report",
        "cotama run patrol --trace run.jsonl --no-report",
        "cotama run patrol --no-report --energy-limit 4000000",
        "cotama run fleet",
        "cotama run service",
        "cotama allocate small.json",
        "cotama assign home.json",
        "cotama check door",
        "cotama check robot.net --property 'AG idle' --trace it.html",
        "cotama check open.net",
        "cotama check 'my cycle.net' --property 'EF deadlock' --certificate it.json",
        "cotama statespace robot.net",
        "cotama simulate robot.net +9",
        "cotama simulate open.net +9",
        "cotama simulate door Call --trace door.jsonl",
        "cotama conform door door.jsonl",
        "cotama estimate door --property 'EF Open' --runs 100",
        "cotama fmeca",
        "cotama fmeca gripper.toml",
        "cotama fmeca 'my gripper.toml' --output it.html",
        "cotama new mission other",
        "cotama new fmeca other",
        "cotama new net lonely",
        "cotama new board lonely",
        "cotama export door --format chart",
        "cotama export 'my cycle.net' --format scxml",
    ]
    .into_iter()
    .enumerate()
    {
        let folder = Folder::new(&format!("next_{number}"));
        folder.write("robot.net", ROBOT);
        folder.write("open.net", OPEN);
        folder.write("my cycle.net", CYCLE);
        folder.write("my walk.toml", patrol(&[]));
        folder.write(
            "small.json",
            "{\"limits\":{\"duration_ms\":9,\"energy_mj\":9},\"activities\":[[[1,2,3]]]}",
        );
        let hall = include_str!("../templates/mission.toml");
        folder.write("hall.toml", hall);
        let limit = hall.lines().find(|it| it.starts_with("duration_ms")).unwrap();
        folder.write("slow.toml", hall.replacen(limit, "duration_ms = 93000", 1));
        let blocked = "format = \"panorama-faults/1\"\n[[event]]\nx_mm = 5000\n\
            kind = \"obstacle\"\ndelay_ms = 300000\n";
        folder.write("blocked.toml", blocked);
        let home = concat!(env!("CARGO_MANIFEST_DIR"), "/../models/teams");
        let home = std::fs::read_dir(home).unwrap().map(|it| it.unwrap().path());
        let home = home.flat_map(|it| std::fs::read_dir(it).into_iter().flatten());
        let home = home
            .map(|it| it.unwrap().path())
            .find(|it| it.extension().is_some_and(|e| e == "json"));
        folder.write("home.json", std::fs::read(home.unwrap()).unwrap());
        let fmeca = include_str!("../templates/fmeca.toml");
        folder.write("gripper.toml", fmeca);
        folder.write("my gripper.toml", fmeca);
        if line.starts_with("cotama conform") {
            folder.shell("cotama simulate door Call EndOpen@2000 +5000 --trace door.jsonl");
        }
        all += follow(&folder, line, &mut BTreeSet::new(), 1);
    }
    assert!(all > 60, "{all} commands");
}

/// A crate cannot be built without the sources beside it, and can be with them.
#[test]
fn a_new_crate_says_how_to_test_it_only_where_that_works() {
    let folder = Folder::new("next_crates");
    let sources = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let next = |line: &str| {
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!(ended.code, Some(0), "{line}: {ended:?}");
        ended.stdout.lines().find_map(|it| it.strip_prefix("next: ")).map(str::to_owned)
    };
    assert_eq!(next("new net alone"), None);
    assert_eq!(next("new system lonely"), None);
    assert_eq!(next("new board alone"), None);
    let with = format!("--sources '{sources}'");
    assert_eq!(next(&format!("new net gate {with}")).as_deref(), Some("cd gate && cargo test"));
    // The board takes the sources of the crate.
    let board = next("new board gate").unwrap();
    assert!(board.starts_with("cd gate-board && cargo "), "{board}");
    let manifest = folder.read("gate-board/Cargo.toml");
    let path = folder.read("gate/Cargo.toml");
    let path = path.lines().find(|it| it.starts_with("cotama-core")).unwrap();
    let path = path.split('"').nth(1).unwrap();
    assert!(manifest.contains(&format!("\"{path}\"")), "{manifest}");
}

/// A board plays the net that the crate has now.
#[test]
fn a_board_is_made_for_the_net_as_it_was_changed() {
    let folder = Folder::new("next_board");
    for (name, places, events, list) in [
        ("one", "A: 1, B", "open, shut", "    (0, Event::open),\n    (100, Event::shut),\n];"),
        ("two", "P: 1", "go", "; 1] = [\n    (0, Event::go),\n];"),
        ("three", "P: 1", "", "const EVENTS: [(u64, Event); 0] = [];"),
        ("four", "P: 1, Q", "goal(Pose), halt", "; 1] = [\n    (0, Event::halt),\n];\n// `goal`"),
        ("five", "P: 1", "start, heard, stop", "    (200, Event::stop),\n];"),
    ] {
        folder.shell(&format!("cotama new net {name}"));
        let text = format!(
            "#![no_std]\nuse cotama_core::net;\nnet! {{\n    /// Mine.\n    pub mod mine {{\n    \
             \x20   places {{ {places} }}\n        events {{ {events} }}\n        \
             transitions {{ }}\n    }}\n}}\n"
        );
        folder.write(&format!("{name}/src/lib.rs"), text);
        let ended = folder.shell(&format!("cotama new board {name}"));
        assert_eq!(ended.code, Some(0), "{ended:?}");
        let main = folder.read(&format!("{name}-board/src/main.rs"));
        assert!(main.contains(list), "{main}");
        assert!(main.contains(&format!("use {name}::mine::{{Event, Firing, NET, Player}};")));
        assert!(!main.contains(".state()"), "{main}");
    }
    folder.shell("cotama new net none");
    folder.write("none/src/lib.rs", "pub fn nothing() {}\n");
    let ended = folder.shell("cotama new board none");
    assert!(ended.code == Some(2) && ended.stderr.contains("no `pub mod` of a net"), "{ended:?}");
}
