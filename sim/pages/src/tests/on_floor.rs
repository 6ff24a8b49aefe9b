//! The run on its floor.

use crate::mission::html;
use cotama_floor::{Ground, Needs, embedded::OFFICE};
use cotama_models::missions::{Asked, Mission};
use cotama_models::robots::RobotFile;
use cotama_sim::options::Options;
use cotama_sim::trace::Trace;

/// A drive from the dock to an office, with a failure on the way.
fn page() -> String {
    let text = r#"
format = "panorama-mission/2"
name = "there"
robot = "transport"
floor = "office"
from = "dock"
limits = { order = ["duration", "energy"], duration_ms = 400_000, energy_mj = 50_000_000 }
objective = [{ id = "There", does = "drive", to = "office B" }]
run.event = [{ x_mm = 9_000, kind = "failure", mode = "CAM1" }]
"#;
    let asked = Asked::of(text).unwrap();
    let floor = OFFICE.floor().unwrap();
    let way = Ground::Drawing(&floor).way(OFFICE.name, OFFICE.text, asked, Needs::default());
    let robot = RobotFile::shipped("transport");
    let mission = Mission::parse_on("there", text, robot, Some(&way)).unwrap();
    html(&Trace::record(&mission, &Options::default()).unwrap().0)
}

#[test]
fn a_robot_moves_from_the_first_corner_of_the_way_to_the_last() {
    let page = page();
    let (_, script) = page.split_once("var RUN=").unwrap();
    let (data, _) = script.split_once(";\n").unwrap();
    let run: serde_json::Value = serde_json::from_str(data).unwrap();
    let rows = |key: &str| run[key].as_array().unwrap().clone();
    let (way, samples) = (rows("way"), rows("samples"));
    assert_eq!((way[0][0].as_u64(), samples[0][1].as_u64()), (Some(0), Some(0)));
    let ends = [&way[way.len() - 1][0], &samples[samples.len() - 1][1]];
    assert_eq!(ends.map(serde_json::Value::as_u64), [Some(14_507); 2]);
    assert!(rows("runs").iter().any(|it| it[1] == "Follow.Low"));
}

#[test]
fn points_of_the_story_stand_on_the_floor_and_each_curve_has_its_cursor() {
    let page = page();
    let (_, section) = page.split_once("<section class=\"onfloor\">").unwrap();
    let (floor, rest) = section.split_once("</section>").unwrap();
    let pins =
        floor.split("<g><title>").filter_map(|it| it.split_once("</title><circle class=\"pin\""));
    let titles: Vec<_> = pins.map(|it| it.0.replace('\u{a0}', " ")).collect();
    assert_eq!(
        titles,
        ["the mission is received, 0.0 s", "CAM1: depth camera, no depth image, 9.7 s"]
    );
    assert!(floor.contains("<title>office</title>") && floor.contains("class=\"way\""));
    assert_eq!(rest.matches("<line class=\"cursor\"").count(), 2); // wide and narrow
}
