//! `cotama run service` and `cotama run fleet`: teams of robots.

use crate::common::{Folder, golden};
use crate::schemas::validate;
use serde_json::json;

#[test]
fn the_service_is_that_of_the_thesis() {
    let folder = Folder::new("team_service");
    let screen = folder.cotama(&["run", "service"]);
    assert_eq!((screen.code, screen.stderr.as_str()), (Some(0), ""));
    golden("run_service.txt", &screen.stdout);
    let page = folder.read("report/service/index.html");
    assert!(page.contains("All 2 tasks are done") && page.contains("fetch-and-bring"));
    let answer = folder.cotama(&["run", "service", "--json", "--no-report"]).json(0);
    validate("run-team", &answer);
    let awards = answer["run"]["awards"].as_array().unwrap().iter();
    let awards: Vec<_> = awards.map(|it| json!([it["task"], it["plan"], it["robots"]])).collect();
    assert_eq!(
        awards,
        [
            json!(["order", "order", ["Eddie"]]),
            json!(["serve", "bring", ["Eddie"]]),
            json!(["serve", "fetch-and-bring", ["Poppy", "Eddie"]]),
            json!(["serve", "fetch", ["Poppy"]]),
        ]
    );
    let errors = answer["run"]["errors"].as_array().unwrap().iter();
    let classes: Vec<_> = errors.map(|it| it["class"].clone()).collect();
    assert_eq!(classes, ["recoverable", "semi-recoverable", "semi-recoverable"]);
}

#[test]
fn a_cup_out_of_reach_is_fetched_for_another_robot() {
    let folder = Folder::new("team_handle");
    let answer = folder.cotama(&["run", "service", "--hidden-handle", "--json"]).json(0);
    let awards = answer["run"]["awards"].as_array().unwrap();
    assert_eq!(awards.len(), 2);
    assert_eq!(awards[1]["robots"], json!(["Poppy", "Eddie"]));
}

#[test]
fn a_fleet_ends_all_its_tasks_and_leaves_a_trace() {
    let folder = Folder::new("team_fleet");
    let small = ["run", "fleet", "--robots", "8", "--tasks", "20", "--failures", "2"];
    let with = |more: &[&str]| folder.cotama(&[&small[..], more].concat());
    golden("run_fleet.txt", &with(&["--loss", "10", "--seed", "3"]).stdout);
    let answer = with(&["--json", "--trace", "t.jsonl"]).json(0);
    validate("run-team", &answer);
    assert_eq!((&answer["outcome"], &answer["run"]["done"]), (&json!("completed"), &json!(20)));
    let trace = folder.read("t.jsonl");
    let first: serde_json::Value = serde_json::from_str(trace.lines().next().unwrap()).unwrap();
    assert_eq!(first["schema"], "cotama/team-trace/1");
    assert!(trace.lines().last().unwrap().contains("\"record\":\"end\""));
    assert_eq!(trace.lines().filter(|it| it.contains("\"record\":\"done\"")).count(), 20);
}

#[test]
fn allocations_are_compared_on_common_seeds() {
    let folder = Folder::new("team_seeds");
    let small = ["run", "fleet", "--robots", "6", "--tasks", "12", "--seeds", "4"];
    golden("run_fleet_seeds.txt", &folder.cotama(&small).stdout);
    let answer = folder.cotama(&[&small[..], &["--json"]].concat()).json(0);
    validate("run-team", &answer);
    let rows = answer["compared"]["allocations"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|it| it["allocation"].clone()).collect();
    assert_eq!(names, ["optimal", "rounds", "one-by-one"]);
    assert_eq!(rows[0]["more_ms"], json!({ "mean": 0, "low": 0, "high": 0 }));
}

#[test]
fn options_of_missions_and_of_teams_are_told_apart() {
    let folder = Folder::new("team_options");
    for (line, said) in [
        ("run patrol --robots 3", "--robots is for teams"),
        ("run flete", "did you mean the team `fleet`?"),
        ("run fleet --upward", "--upward is for missions"),
        ("run fleet --faults f.toml", "teams read no file of faults"),
        ("run fleet --hidden-handle", "is for `cotama run service`"),
        ("run service --tasks 3", "--tasks is for `cotama run fleet`"),
        ("run fleet --robots 3 --failures 4", "there are 3 robots"),
        ("run fleet --loss 51", "a number from 0 to 50"),
        ("run fleet --robots 65", "from 1 to 64"),
    ] {
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!(ended.code, Some(2), "{line}");
        assert!(ended.stderr.contains(said), "{line}: {}", ended.stderr);
    }
}
