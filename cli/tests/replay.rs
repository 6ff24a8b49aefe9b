//! `cotama replay`: traces that come out the same, and those that do not.

use crate::common::Folder;
use serde_json::json;

fn with_trace(name: &str) -> Folder {
    let folder = Folder::new(name);
    let arguments =
        ["run", "patrol", "--seed", "3", "--json", "--no-report", "--trace", "patrol.jsonl"];
    assert_eq!(folder.cotama(&arguments).json(0)["trace"], "patrol.jsonl");
    folder
}

#[test]
fn a_trace_comes_out_the_same() {
    let folder = with_trace("replay_same");
    let arguments =
        ["replay", "patrol.jsonl", "--json", "--trace", "again.jsonl", "--report", "again"];
    let answer = folder.cotama(&arguments).json(0);
    assert_eq!((&answer["identical"], &answer["seed"]), (&json!(true), &json!(3)));
    assert_eq!((&answer["replans"], &answer["report"]), (&json!(3), &json!("again/index.html")));
    assert_eq!(folder.read("again.jsonl"), folder.read("patrol.jsonl"));
    let screen = folder.cotama(&["replay", "patrol.jsonl"]);
    assert!(
        screen.stdout.ends_with("identical: the run was the same again, in every record\n"),
        "{screen:?}"
    );
}

#[test]
fn a_changed_trace_does_not() {
    let folder = with_trace("replay_changed");
    let changed =
        folder.read("patrol.jsonl").replacen("\"real_power_mw\":1", "\"real_power_mw\":2", 1);
    folder.write("changed.jsonl", changed);
    let ended = folder.cotama(&["replay", "changed.jsonl", "--json"]);
    assert_eq!(ended.json(1)["identical"], false);
}

#[test]
fn a_file_of_faults_is_run_twice() {
    let folder = Folder::new("replay_faults");
    folder.write(
        "faults.toml",
        "format = \"panorama-faults/1\"\nrandom = \
        [{ name = \"people\", per_km = 50, kind = \"obstacle\", delay_ms = 900 }]\n",
    );
    let arguments = ["replay", "faults.toml", "--mission", "patrol", "--seed", "5", "--json"];
    let answer = folder.cotama(&arguments).json(0);
    assert_eq!((&answer["identical"], &answer["outcome"]), (&json!(true), &json!("completed")));
    assert!(!answer["events"].as_array().unwrap().is_empty());
}
