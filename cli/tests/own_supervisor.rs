//! A net of one's own as the local supervisor of a robot: checked with the rest, driving a mission,
//! and refused where it does not fit.

use crate::common::Folder;
use serde_json::{Value, json};

const GRIPPER: &str = r#"format = "cotama-robot/1"
name = "gripper"
hardware = { base = {}, arm = {}, radio = {} }
observer = { eye = { flags = ["dropped", "arm error", "link silent"] } }
operator = { needs = ["link"] }
[module]
drive = { hardware = ["base"] }
grip = { hardware = ["arm"] }
link = { hardware = ["radio"] }
[[configuration]]
name = "Go"
sub_objective = "Follow"
mode = "autonomous"
required = ["drive"]
speed_mm_s = 500
[[configuration]]
name = "Take"
sub_objective = "Grasp"
mode = "autonomous"
required = ["grip"]
takes_ms = 4_000
[[configuration]]
name = "Hand"
sub_objective = "Manual"
mode = "operator"
required = ["drive", "link"]
speed_mm_s = 200
[body]
speed_max_mm_s = 500
acceleration_mm_s2 = 300
motion_power = { c0 = 5_000, c1 = 7_000, c2 = 0 }
[[failure]]
id = "SLIP1"
mode = "the object slips"
severity = { autonomous = "hard", operator = "weak" }
flags = ["dropped"]
latency_ms = 300
ends_ms = 1_000
[[failure]]
id = "ARM1"
mode = "arm reports an error"
severity = { autonomous = "hard", operator = "weak" }
flags = ["arm error"]
loses = ["arm"]
[[failure]]
id = "LNK1"
mode = "no link"
severity = { autonomous = "weak", operator = "fatal" }
flags = ["link silent"]
loses = ["radio"]
"#;

const MISSION: &str = r#"format = "panorama-mission/2"
name = "fetch"
robot = "own.toml"
path_length_mm = 20_000
limits = { order = ["duration", "energy"], duration_ms = 200_000, energy_mj = 9_000_000 }
tio = [{ id = "hold", task = "GRASP", duration_ms = 1_000, power_mw = 1_000 }]
objective = [
  { id = "there", does = "drive", x_start_mm = 0, x_end_mm = 20_000 },
  { id = "hold", does = "grasp", x_start_mm = 20_000, x_end_mm = 20_000 },
]
[run]
event = [{ during = "Grasp", after_ms = 500, kind = "failure", mode = "SLIP1" }]
"#;

fn arcs(places: &[&str]) -> Value {
    places.iter().map(|it| json!({ "place": it, "weight": 1 })).collect()
}

fn place(name: &str, initial: u32, role: &Value) -> Value {
    let own = json!({ "name": name, "doc": "", "initial": initial });
    let mut place = json!({ "bound": 1, "role": role });
    place.as_object_mut().unwrap().extend(own.as_object().unwrap().clone());
    place
}

/// The made supervisor, which grasps again when the first grasp slips before it asks anybody.
fn grasps_again(mut net: Value) -> Value {
    let places = net["places"].as_array_mut().unwrap();
    places.push(place("slipped", 0, &json!("data")));
    places.push(place("!slipped", 1, &json!({ "complement": "slipped" })));
    let lines = net["transitions"].as_array_mut().unwrap();
    let ask = lines.iter().position(|it| it["name"] == "ask_Grasp").unwrap();
    let line = |name: &str, change: &dyn Fn(&mut Value)| {
        let mut line = lines[ask].clone();
        line["name"] = json!(name);
        change(&mut line);
        line
    };
    let again = line("again", &|it| {
        it["take"] = arcs(&["Grasp", "!slipped"]);
        it["read"] = arcs(&["!lost_arm"]);
        it["give"] = arcs(&["Grasp", "slipped"]);
        it["emits"] = json!(["stop_Grasp", "start_Grasp"]);
    });
    let broken = line("ask_for_the_arm", &|it| it["read"] = arcs(&["!slipped", "lost_arm"]));
    let twice = line("ask_Grasp", &|it| it["read"] = arcs(&["slipped"]));
    lines.splice(ask..=ask, [again, broken, twice]);
    net
}

#[test]
fn a_gripper_grasps_again_under_a_local_supervisor_of_its_own() {
    let folder = Folder::new("own_supervisor");
    folder.write("gripper.toml", GRIPPER);
    let made = folder.cotama(&["export", "gripper.toml", "--net", "ls", "--format", "json"]);
    let own = grasps_again(serde_json::from_str(&made.stdout).unwrap());
    folder.write("local.json", own.to_string());
    folder.write("own.toml", format!("{GRIPPER}[supervisors]\nlocal = \"local.json\"\n"));
    folder.write("fetch.toml", MISSION);

    let checked = folder.cotama(&["check", "own.toml", "--json"]).json(0);
    let results = checked["results"].as_array().unwrap();
    assert!(results.len() == 13 && results.iter().all(|it| it["verdict"] == "true"), "{checked}");
    let run = folder.cotama(&["run", "fetch.toml", "--no-report", "--json", "--trace", "f.jsonl"]);
    assert_eq!(run.json(0)["operator_requests"], 0);
    assert!(folder.read("f.jsonl").contains("\"transition\":\"again\""));
    // The trace holds the net.
    folder.write("local.json", "");
    assert_eq!(folder.cotama(&["replay", "f.jsonl", "--json"]).json(0)["identical"], true);
    folder.write("local.json", own.to_string());
    assert_eq!(folder.cotama(&["conform", "own.toml", "f.jsonl", "--json"]).json(0)["events"], 5);
    // Under the one that is made, the operator is asked.
    folder.write("fetch.toml", MISSION.replace("own.toml", "gripper.toml"));
    let run = folder.cotama(&["run", "fetch.toml", "--no-report", "--json"]).json(0);
    assert_eq!(run["operator_requests"], 1);
}

#[test]
fn a_net_that_is_no_local_supervisor_is_refused_with_the_reason() {
    let folder = Folder::new("own_supervisor_refused");
    folder.write("gripper.toml", GRIPPER);
    folder.write("own.toml", format!("{GRIPPER}[supervisors]\nlocal = \"local.json\"\n"));
    let made = folder.cotama(&["export", "gripper.toml", "--net", "ls", "--format", "json"]);
    let made: Value = serde_json::from_str(&made.stdout).unwrap();
    let refused = |said: &str| {
        let ended = folder.cotama(&["check", "own.toml"]);
        assert_eq!(ended.code, Some(2), "{}", ended.stdout);
        assert!(ended.stderr.contains(said) && ended.stderr.contains("own.toml:52:9"), "{ended:?}");
    };
    refused("local.json: No such file");

    let mut lacks = made.clone();
    lacks["events"].as_array_mut().unwrap().retain(|it| it["name"] != "gs_abort");
    lacks["transitions"].as_array_mut().unwrap().retain(|it| it["on"] != "gs_abort");
    folder.write("local.json", lacks.to_string());
    refused("`local.json` is no local supervisor of this robot: it lacks the event `gs_abort`");

    let mut timed = made.clone();
    timed["transitions"][0]["within"] = json!({ "earliest": 1, "latest": 2 });
    folder.write("local.json", timed.to_string());
    refused("rounds have no time, and `start1` has an interval");

    let mut wide = made.clone();
    let places = wide["places"].as_array_mut().unwrap();
    places.iter_mut().find(|it| it["name"] == "Waits").unwrap()["bound"] = json!(2);
    folder.write("local.json", wide.to_string());
    refused("`local.json` does not fit the other supervisors: ");

    // It waits for the operator with the permit to move.
    let mut moves = made;
    let lines = moves["transitions"].as_array_mut().unwrap();
    lines.iter_mut().find(|it| it["name"] == "ask_Follow").unwrap()["emits"] = json!([]);
    folder.write("local.json", moves.to_string());
    let checked = folder.cotama(&["check", "own.toml", "--json"]).json(1);
    let broken: Vec<_> = checked["results"].as_array().unwrap().iter().collect();
    let broken: Vec<_> = broken.iter().filter(|it| it["verdict"] == "false").collect();
    assert_eq!((broken.len(), &broken[0]["id"]), (1, &json!("LS2")));
}
