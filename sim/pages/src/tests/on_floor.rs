//! The run on its floor.

use crate::mission::html;
use crate::team;
use cotama_floor::embedded::{OFFICE, SERVICE};
use cotama_floor::{Ground, Needs, Point, Surface, Version};
use cotama_models::missions::{Asked, Mission};
use cotama_models::robots::RobotFile;
use cotama_sim::fleet;
use cotama_sim::fleet::scenarios::{ServiceOptions, service};
use cotama_sim::options::{Fidelity, Options};
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

/// The object of the script of a page.
fn run(page: &str) -> serde_json::Value {
    let (_, script) = page.split_once("var RUN=").unwrap();
    let (data, _) = script.split_once(";\n").unwrap();
    serde_json::from_str(data).unwrap()
}

#[test]
fn a_robot_moves_from_the_first_corner_of_the_way_to_the_last() {
    let run = run(&page());
    let rows = |key: &str| run[key].as_array().unwrap().clone();
    let (way, samples) = (rows("way"), rows("samples"));
    assert_eq!((way[0][0].as_u64(), samples[0][1].as_u64()), (Some(0), Some(0)));
    let ends = [&way[way.len() - 1][0], &samples[samples.len() - 1][1]];
    assert_eq!(ends.map(serde_json::Value::as_u64), [Some(14_507); 2]);
    assert!(rows("runs").iter().any(|it| it[1] == "Follow.Low"));
}

#[test]
fn corridors_that_are_longer_than_the_mission_say_what_makes_them_so() {
    let patrol = cotama_models::missions::embedded::mission("patrol").unwrap();
    let robot = RobotFile::shipped("p3dx-patrol");
    let mission = Mission::parse_on(patrol.name, patrol.text, robot, None).unwrap();
    let options = Options { fidelity: Fidelity::Plane, ..Options::default() };
    let page = html(&Trace::record(&mission, &options).unwrap().0).replace('\u{a0}', " ");
    let words =
        "191.1 m from place to place: 187.0 m of the mission and 4.1 m that wrong positions";
    assert!(page.contains(words));
}

#[test]
fn a_robot_in_the_plane_has_the_rays_of_its_sonars_at_each_pose() {
    let known = cotama_models::missions::embedded::mission("delivery").unwrap();
    let mission = Mission::parse(known.name, known.text).unwrap();
    let options = Options { fidelity: Fidelity::Plane, ..Options::default() };
    let run = run(&html(&Trace::record(&mission, &options).unwrap().0));
    let [poses, rays] = ["poses", "rays"].map(|it| run[it].as_array().unwrap().clone());
    assert_eq!(poses.len(), rays.len());
    assert!(rays.iter().all(|it| it.as_array().unwrap().len() == 32));
    // At the start, in the middle of its corridor, left and right are as far.
    let of = |row: &serde_json::Value, at: usize| row[at].as_f64().unwrap();
    let side = |end: usize| (of(&rays[0], end) - of(&poses[0], 2)).abs();
    assert!((side(1) - side(15)).abs() < 0.2 && side(1) > 10.0, "{} {}", side(1), side(15));
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

/// The page of the service with its disturbances.
fn served() -> String {
    let options = ServiceOptions { disturbances: true, ..ServiceOptions::default() };
    team::html(&fleet::trace::Trace::of(&service(&options)))
}

#[test]
fn robots_of_a_team_are_drawn_on_free_floor_at_any_time() {
    let floor = SERVICE.floor().unwrap();
    let surface = floor.surface(Version::Charted, &[]).unwrap();
    // A margin of 24 pixels around the floor, whose longer side has 1,200.
    let scale = 1_200.0 / floor.bounds().width();
    let height = floor.bounds().height();
    let run = run(&served());
    let tracks = run["robots"].as_array().unwrap();
    assert_eq!(tracks.len(), 4);
    let mut moved = 0;
    for track in tracks {
        let moments: Vec<[f64; 3]> = serde_json::from_value(track.clone()).unwrap();
        assert!(moments.is_sorted_by(|a, b| a[0] <= b[0]));
        moved += usize::from(moments.len() > 2);
        for pair in moments.windows(2) {
            for tenth in 0..=10 {
                let between =
                    |it: usize| pair[0][it] + (pair[1][it] - pair[0][it]) * f64::from(tenth) / 10.0;
                let x = (between(1) - 24.0) / scale;
                let y = height - (between(2) - 24.0) / scale;
                // Moments are within half a pixel of the path.
                let room = surface.clearance(Point::new(x, y), 1.0);
                assert!(room > 0.26 - 0.5 / scale, "{room} at {x}, {y}");
            }
        }
    }
    assert_eq!(moved, 2); // Eddie and Poppy
}

#[test]
fn tasks_of_a_team_go_from_their_place_to_a_robot_and_to_their_goal() {
    let page = served();
    let run = run(&page);
    let states = |task: usize| {
        let changes = run["tasks"][task].as_array().unwrap().iter();
        changes.map(|it| (it[1].as_str().unwrap().to_owned(), it[2].as_i64().unwrap())).collect()
    };
    let named = |all: &[(&str, i64)]| -> Vec<(String, i64)> {
        all.iter().map(|it| (it.0.to_owned(), it.1)).collect()
    };
    let order: Vec<(String, i64)> = states(0);
    assert_eq!(order, named(&[("waits", -1), ("awarded", -1), ("done", -1)]));
    // Poppy, the third robot, has the cup on board when Eddie is stopped.
    let serve: Vec<(String, i64)> = states(1);
    assert_eq!(serve.last(), Some(&("done".to_owned(), -1)));
    assert!(serve.contains(&("carried".to_owned(), 2)), "{serve:?}");
    assert!(page.contains("<b class=\"disc\">E</b> Eddie"));
    assert_eq!(page.matches("<line class=\"cursor\"").count(), 2); // wide and narrow
    assert!(!page.contains("http://localhost") && !page.contains("src=\"http"));
}
