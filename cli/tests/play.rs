//! `cotama play`: pages in which models are played. Their runs are held against those of the
//! program by `sim/playground/module/check.py`.

use crate::common::Folder;
use crate::schemas::validate;
use serde_json::{Value, json};

/// The data of a page.
fn data(page: &str) -> Value {
    let (_, data) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_page_holds_all_that_it_needs() {
    let folder = Folder::new("play");
    let answer = folder.cotama(&["play", "door", "--json"]).json(0);
    validate("play", &answer);
    assert_eq!(answer["file"], "door.html");
    let page = folder.read("door.html");
    assert_eq!(answer["bytes"], page.len());
    for outside in ["src=", "@import", "url(", "fetch(", "XMLHttpRequest"] {
        assert!(!page.contains(outside), "{outside}");
    }
    let data = data(&page);
    assert_eq!(data["events"][0], json!(["Call", "Somebody wants to pass."]));
    assert_eq!(data["transitions"][0], json!(["call", 0, null]));
    assert_eq!((&data["system"], &data["by_name"]), (&json!(false), &json!(false)));
}

#[test]
fn a_transition_that_nobody_tells_says_why_it_fires() {
    let folder = Folder::new("play_why");
    assert_eq!(folder.cotama(&["play", "delivery", "--output", "d.html"]).code, Some(0));
    let data = data(&folder.read("d.html"));
    let transitions = data["transitions"].as_array().unwrap();
    let why = |name: &str| transitions.iter().find(|it| it[0] == name).unwrap()[2].clone();
    assert_eq!(why("gs.g1"), Value::Null);
    assert_eq!(why("ls.start1"), "answers start_drive, which other nets say: gs.start_drive");
    assert_eq!((&data["system"], &data["mail"]), (&json!(true), &json!(true)));
}

#[test]
fn a_model_that_cannot_be_played_is_refused_and_leaves_no_page() {
    let folder = Folder::new("play_refused");
    let refused = folder.cotama(&["play", "philosophers:5000"]);
    assert_eq!(refused.code, Some(2));
    let simulated = folder.cotama(&["simulate", "philosophers:5000", "x"]);
    assert_eq!(refused.stderr, simulated.stderr);
    assert_eq!(folder.cotama(&["play", "dor"]).code, Some(2));
    assert_eq!(folder.cotama(&["play", "door", "--output", "none/door.html"]).code, Some(2));
    assert_eq!(folder.files(""), [""; 0]);
}

fn place(name: &str, initial: u32) -> Value {
    json!({ "name": name, "doc": name, "initial": initial, "bound": 1, "role": "state" })
}

#[test]
fn names_of_a_file_do_nothing_in_its_page() {
    let folder = Folder::new("play_names");
    let name = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'&\u{202e}";
    let arc = |place: &str| json!([{ "place": place, "weight": 1 }]);
    let net = json!({ "schema": "cotama/net/1", "name": name, "doc": name,
        "places": [place(name, 1), place("other", 0)],
        "events": [{ "name": name, "doc": name }], "outputs": [{ "name": name, "doc": name }],
        "transitions": [{ "name": name, "doc": name, "line": 0, "on": name, "take": arc(name),
            "read": [], "give": arc("other"), "emits": [name], "within": null, "priority": 0 }],
        "ignored": [], "laws": [] });
    folder.write("net.json", net.to_string());
    assert_eq!(folder.cotama(&["play", "net.json"]).code, Some(0));
    let page = folder.read("net.html");
    assert_eq!((page.matches("<script").count(), page.matches("</script").count()), (2, 2));
    assert!(!page.contains("<img") && !page.contains('\u{202e}'));
    assert_eq!(data(&page)["events"][0][0], name);
}

const WEAK: &str = "format = \"panorama-faults/1\"
event = [
  { t_ms = 7000, kind = \"failure\", mode = \"MOT2\", until_t_ms = 90000 },
  { x_mm = 2000, kind = \"obstacle\", delay_ms = 5000 },
  { x_mm = 1000, kind = \"operator\", answers = [\"Teleoperation\", \"done\"], delay_ms = 9000 },
]
";

#[test]
fn a_plan_of_faults_is_in_its_page_and_reads_back_from_it() {
    let folder = Folder::new("play_faults");
    folder.write("weak.toml", WEAK);
    let play = folder.cotama(&["play", "weak.toml", "--mission", "delivery"]);
    assert_eq!(play.code, Some(0));
    let outing = &data(&folder.read("weak.html"))["outing"];
    let items = outing["items"].as_array().unwrap();
    let of = |it: &Value| (it["kind"].clone(), it["when"].clone(), it["until"].clone());
    // Moments: 0 is a place, 1 a time.
    let none = Value::Null;
    assert_eq!(of(&items[0]), (json!("operator"), json!([0, 1000, 0]), none));
    assert_eq!(of(&items[1]), (json!("failure"), json!([1, 0, 7000]), json!([1, 0, 90000])));
    assert_eq!(items[0]["answers"][0], 9000);
    assert_eq!(outing["unshown"], json!(["an obstacle for 5 s, at 2.0 m"]));
    assert_eq!(outing["command"], "cotama run delivery --faults");
    // As the page writes it.
    let moments = ["x_mm = 1000", "t_ms = 7000"];
    let events = items
        .iter()
        .zip(moments)
        .map(|(it, moment)| format!("\n[[event]]\n{moment}\n{}\n", it["text"].as_str().unwrap()));
    let written = format!("{}{}", outing["rest"].as_str().unwrap(), events.collect::<String>());
    folder.write("again.toml", written);
    let run = |file| folder.cotama(&["run", "delivery", "--faults", file, "--no-report", "--json"]);
    assert_eq!(run("weak.toml").json(0)["used"], run("again.toml").json(0)["used"]);
}

#[test]
fn a_file_of_faults_needs_a_mission_with_supervisors() {
    let folder = Folder::new("play_no_mission");
    folder.write("weak.toml", WEAK);
    let nothing = folder.cotama(&["play", "weak.toml"]);
    assert_eq!(nothing.code, Some(2));
    assert!(nothing.stderr.contains("does not say of which mission it is"), "{}", nothing.stderr);
    let event = "[[event]]\nx_mm = 3\nkind = \"obstacle\"\ndelay_ms = 5000\n";
    folder.write("plain.toml", format!("format = \"panorama-faults/1\"\n{event}"));
    let plain = folder.cotama(&["play", "plain.toml", "--mission", "patrol"]);
    assert_eq!(plain.code, Some(2));
    assert!(plain.stderr.contains("has no robot, so no supervisors"), "{}", plain.stderr);
    let door = folder.cotama(&["play", "door", "--mission", "delivery"]);
    assert_eq!(door.code, Some(2));
    assert_eq!(folder.files("").len(), 2);
}

#[test]
fn a_trace_of_a_run_has_its_faults_and_its_floor() {
    let folder = Folder::new("play_trace");
    let run = ["run", "ward", "--no-report", "--trace", "run.jsonl"];
    assert_eq!(folder.cotama(&run).code, Some(0));
    assert_eq!(folder.cotama(&["play", "run.jsonl"]).code, Some(0));
    let page = folder.read("run.html");
    assert!(page.contains("<section class=\"onfloor\">") && page.contains("var RUN={"));
    let outing = &data(&page)["outing"];
    assert_eq!((&outing["from"], &outing["floor"]), (&json!("the run in run.jsonl"), &json!(true)));
    assert_eq!(outing["items"].as_array().unwrap().len(), 4);
}

#[test]
fn a_team_that_is_too_large_is_played_by_its_first_task() {
    let folder = Folder::new("play_team");
    assert_eq!(folder.cotama(&["play", "fleet"]).code, Some(0));
    let page = folder.read("fleet.html");
    assert!(page.contains("Of 40 robots and 200 tasks this is the first task"));
    assert!(data(&page)["events"].as_array().unwrap().len() > 20);
}
