//! Crates by `cotama new` work as they are, and a refusal leaves nothing behind.

use crate::common::{Ended, Folder};
use std::path::Path;
use std::process::Command;

/// The sources of this project.
const SOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

#[test]
fn a_mission_is_planned_and_run_as_it_is_written() {
    let folder = Folder::new("new_mission");
    let answer = folder.cotama(&["new", "mission", "hall_2", "--json"]).json(0);
    assert_eq!(answer["files"], serde_json::json!(["hall_2.toml"]));
    let plan = folder.cotama(&["plan", "hall_2.toml", "--json"]).json(0);
    assert_eq!(plan["mission"], "hall_2");
    let run = folder.cotama(&["run", "hall_2.toml", "--objective", "quality", "--json"]).json(0);
    assert_eq!((&run["outcome"], &run["replans"]), (&"completed".into(), &1.into()));
    assert_eq!(folder.files("."), ["hall_2.toml", "report"]);
    // Each line that is a comment and holds a key can be used.
    let text = folder.read("hall_2.toml");
    let (optional, rest): (Vec<_>, Vec<_>) =
        text.lines().partition(|line| line.starts_with("# ") && line.contains(" = "));
    let with = |line: &str| {
        let keys = line.trim_start_matches("# ");
        text.replacen(line, keys, 1)
    };
    assert!(optional.len() >= 3 && !rest.is_empty(), "{optional:?}");
    folder.write("zone.toml", with(optional.iter().find(|it| it.contains("require_tio")).unwrap()));
    folder.cotama(&["plan", "zone.toml", "--json"]).json(0);
    let event = text.replace("\n# [[run", "\n[[run").replace("\n# x_mm", "\nx_mm");
    folder.write("event.toml", event.replace("\n# kind", "\nkind").replace("\n# extra", "\nextra"));
    let run = folder.cotama(&["run", "event.toml", "--no-report", "--json"]).json(0);
    assert!(run["events"].as_array().unwrap().iter().any(|it| it["kind"] == "odometry"), "{run}");
}

/// Runs Cargo in a package of a folder, with the versions of this project.
fn cargo(folder: &Folder, package: &str, arguments: &[&str]) -> Ended {
    let package = folder.path().join(package);
    std::fs::copy(Path::new(SOURCES).join("Cargo.lock"), package.join("Cargo.lock")).unwrap();
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .args(["--offline", "--quiet"])
        .current_dir(&package)
        .env("CARGO_TARGET_DIR", folder.path().join("target"))
        .env("CARGO_PROFILE_DEV_DEBUG", "0")
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .output()
        .unwrap();
    Ended {
        code: output.status.code(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

#[test]
fn a_board_plays_the_net_beside_it_and_needs_one() {
    let folder = Folder::new("new_board");
    let none = folder.cotama(&["new", "board", "gate", "--sources", SOURCES]);
    assert_eq!(none.code, Some(2));
    assert!(none.stderr.contains("gate: there is no such crate"), "{}", none.stderr);
    folder.cotama(&["new", "net", "gate", "--sources", SOURCES, "--json"]).json(0);
    let answer = folder.cotama(&["new", "board", "gate", "--sources", SOURCES, "--json"]).json(0);
    let files = ["Cargo.toml", "build.rs", "memory.x", ".cargo/config.toml", "src/main.rs"];
    let files: Vec<_> = files.iter().map(|it| format!("gate-board/{it}")).collect();
    assert_eq!(answer["files"], serde_json::json!(files));
    assert!(folder.read("gate-board/Cargo.toml").contains("gate = { path = \"../gate\" }"));
    assert!(folder.read("gate-board/src/main.rs").contains("use gate::gate::{"));
    let again = folder.cotama(&["new", "board", "gate", "--sources", SOURCES]);
    assert_eq!(again.code, Some(2));
}

/// A run of the net of the template as a robot may log it.
const NAIVE: &str = r#"{"t_ms":0,"event":"start"}
{"t_ms":0,"fired":"start"}
{"t_ms":80,"event":"heard"}
{"t_ms":80,"fired":"still"}
{"t_ms":450,"event":"heard"}
{"t_ms":180,"fired":"miss"}
{"t_ms":280,"fired":"miss"}
{"t_ms":380,"fired":"miss"}
{"t_ms":380,"fired":"lose"}
{"t_ms":450,"fired":"recover"}
{"t_ms":500,"event":"start"}
{"t_ms":500,"fired":"start"}
"#;

#[test]
#[ignore = "a minute: CI runs it"]
fn crates_run_are_checked_and_fail_with_a_counterexample_when_they_are_broken() {
    let folder = Folder::new("new_crates");
    let cases = [
        // A name that holds that of the template.
        (
            "net",
            "my_net-2",
            "lose    [missed == 3]",
            "lose    [missed == 2]",
            "the supervisor is Running",
        ),
        ("system", "robot", "drive.halt now", "drive.halt mail 1", "the drive is Running"),
    ];
    for (kind, name, whole, broken, said) in cases {
        let answer = folder.cotama(&["new", kind, name, "--sources", SOURCES, "--json"]).json(0);
        let files = ["Cargo.toml", "src/lib.rs", "src/main.rs", "tests/checked.rs"];
        let files = files.into_iter().chain(["examples/model.rs"]).map(|it| format!("{name}/{it}"));
        assert_eq!(answer["files"], serde_json::json!(files.collect::<Vec<_>>()));
        for file in answer["files"].as_array().unwrap() {
            let text = folder.read(file.as_str().unwrap());
            assert!(!text.contains("my-") && !text.contains("my_system"), "{file}: {text}");
            assert!(text.lines().all(|it| it.len() <= 100) || text.contains("[workspace]"));
        }
        let ran = cargo(&folder, name, &["run"]);
        assert!(ran.stderr.is_empty() && ran.stdout.contains(said), "{ran:?}");
        let tested = cargo(&folder, name, &["test"]);
        assert!(tested.stderr.is_empty() && tested.stdout.contains("2 passed"), "{tested:?}");
        let model = cargo(&folder, name, &["run", "--example", "model"]);
        folder.write("model.json", model.stdout);
        for command in ["check", "models", "statespace"] {
            folder.cotama(&[command, "model.json", "--json"]).json(0);
        }

        if kind == "net" {
            let log = format!("{name}/log.jsonl");
            let answer = folder.cotama(&["conform", "model.json", &log, "--json"]).json(0);
            assert_eq!((&answer["conforms"], &answer["events"]), (&true.into(), &4.into()));
            // The log that the program prints without a recorder: names of lines, and what fired
            // late behind the event that made it known.
            folder.write("naive.jsonl", NAIVE);
            folder.cotama(&["conform", "model.json", "naive.jsonl", "--json"]).json(0);
            folder.write(
                "naive.jsonl",
                NAIVE.replace("280,\"fired\":\"miss", "281,\"fired\":\"miss"),
            );
            folder.cotama(&["conform", "model.json", "naive.jsonl", "--json"]).json(1);
        }

        let lib = format!("{name}/src/lib.rs");
        let text = folder.read(&lib);
        assert!(text.contains(whole));
        folder.write(&lib, text.replace(whole, broken));
        let tested = cargo(&folder, name, &["test", "everything"]);
        assert_eq!(tested.code, Some(101), "{tested:?}");
        assert!(tested.stdout.contains("does not hold: after "), "{}", tested.stdout);
        assert!(tested.stdout.contains("\ncause: `"), "{}", tested.stdout);
        if kind == "net" {
            let less = text.lines().filter(|it| !it.contains("recover on heard"));
            folder.write(&lib, less.collect::<Vec<_>>().join("\n"));
            let checked = cargo(&folder, name, &["check"]);
            assert!(checked.stderr.contains("event `heard` is neither used nor"), "{checked:?}");
        }
    }
}

#[test]
fn an_existing_file_is_not_replaced_and_none_is_half_written() {
    let folder = Folder::new("new_refused");
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = folder.cotama(&[&["new"], arguments].concat());
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{ended:?}");
        let words = ended.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(says.iter().all(|it| words.contains(it)), "{says:?}: {words}");
    };
    folder.write("hall.toml", "mine");
    folder.write("gate", "mine");
    refused(&["mission", "hall"], &["hall.toml: this is there already", "choose another name"]);
    refused(&["net", "gate"], &["gate: this is there already", "choose another name"]);
    refused(&["mission", "hall.toml"], &["no name for a mission", "`hall` would fit"]);
    refused(&["net", "Big Gate!"], &["no name for a crate", "`big-gate` would fit"]);
    refused(&["net", "../"], &["no name for a crate"]);
    refused(&["net", ""], &["no name for a crate"]);
    refused(&["net", "2nd"], &["begins with a letter"]);
    refused(&["system", "loop"], &["`loop` is a name that Rust", "`my-loop`"]);
    refused(&["system", "link"], &["`link` is a name that Rust or the crate itself needs"]);
    refused(&["net", "none/gate"], &["none: there is no such folder", "`gate` alone"]);
    refused(&["mission", "gate/hall"], &["gate: this is a file, and a folder is needed there"]);
    refused(&["net", "lift", "--sources", "."], &["--sources .: there is no cotama"]);
    refused(&["mission", "lift", "--sources", "."], &["--sources is for crates"]);
    assert_eq!(folder.files("."), ["gate", "hall.toml"]);
    assert_eq!((folder.read("hall.toml"), folder.read("gate")), ("mine".into(), "mine".into()));
}

#[test]
fn a_crate_finds_the_sources_around_it_or_says_where_it_expects_them() {
    let folder = Folder::new("new_sources");
    let paths = |name: &str| {
        let text = folder.read(&format!("{name}/Cargo.toml"));
        let paths = text.lines().filter_map(|it| it.split_once("path = \"")).map(|it| it.1);
        paths.map(|it| it.split('"').next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let noted = folder.cotama(&["new", "net", "lift"]);
    assert!(noted.code == Some(0) && noted.stderr.contains("--sources"), "{noted:?}");
    assert_eq!(paths("lift"), ["../cotama/core", "../cotama/verification"]);
    // As in a clone, and in a folder of it.
    std::fs::create_dir_all(folder.path().join("core")).unwrap();
    std::fs::create_dir_all(folder.path().join("mine")).unwrap();
    folder.write("core/Cargo.toml", "name = \"cotama-core\"");
    assert!(folder.cotama(&["new", "system", "robot"]).stderr.is_empty());
    assert_eq!(paths("robot"), ["../core", "../verification"]);
    assert!(folder.cotama(&["new", "net", "mine/robot"]).stderr.is_empty());
    assert_eq!(paths("mine/robot"), ["../../core", "../../verification"]);
}

#[test]
fn show_prints_the_file_of_a_mission() {
    let folder = Folder::new("show");
    let shown = folder.cotama(&["show", "patrol"]);
    assert_eq!(shown.stdout, crate::common::patrol(&[]));
    let unknown = folder.cotama(&["show", "patroll"]);
    assert!(unknown.code == Some(2) && unknown.stderr.contains("`patrol`"), "{unknown:?}");
}
