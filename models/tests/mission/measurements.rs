//! Measurements of a robot's detections that are refused: one message for each cause.
#![cfg(feature = "std")]
#![allow(clippy::unwrap_used, clippy::indexing_slicing)]

use cotama_models::robots::{Measurement, Robot, embedded_measurement};
use std::fmt::Write;

const SOUND: &str = r#"format = "cotama-measurement/1"
robot = "p3dx-delivery"
mission = "delivery"
seeds = 4
x_mm = 9000
window_ms = 120_000

[[failure]]
id = "SON1"
runs = 4
missed = 1
taken = [
  { for = ["SON1"], delays_ms = [14_600, 14_700] },
  { for = ["HUM1"], delays_ms = [900] },
]

[[failure]]
id = "ODO3"
runs = 4
missed = 4
"#;

fn robot() -> Robot {
    Robot::shipped("p3dx-delivery").unwrap()
}

#[test]
fn a_measurement_that_was_written_is_read_as_it_was() {
    let robot = robot();
    let read = Measurement::parse("it.toml", SOUND, &robot).unwrap();
    let again = Measurement::parse("it.toml", &read.to_toml(&robot, "a test"), &robot).unwrap();
    assert_eq!(again, read);
    let son1 = &read.rows[&robot.failure("SON1").unwrap()];
    assert_eq!((son1.found(), son1.missed(), son1.worst().unwrap().0), (3, 1, 14_700));
}

#[test]
fn the_measurement_that_comes_with_the_program_says_how_it_was_made() {
    let file = embedded_measurement("p3dx-delivery").unwrap();
    let it = Measurement::parse(file.name, file.text, &robot()).unwrap();
    let made = format!("cotama fmeca --measure {} --seeds {}", it.mission, it.seeds);
    assert_eq!(file.text.lines().next().unwrap(), format!("# Measured by: {made}"));
    assert!(it.rows.values().all(|row| row.runs == it.seeds), "a run of each seed");
}

#[test]
fn every_broken_measurement_is_refused_with_its_place_and_a_remedy() {
    let cases = [
        ("another robot", "p3dx-delivery", "p3dx-patrol"),
        ("another format", "measurement/1", "measurement/9"),
        ("an unknown failure", "id = \"ODO3\"", "id = \"ODO33\""),
        ("a failure of no near name", "id = \"ODO3\"", "id = \"wheel\""),
        ("one twice", "id = \"ODO3\"", "id = \"SON1\""),
        ("taken for an unknown failure", "[\"HUM1\"]", "[\"HMU1\"]"),
        ("taken for nothing", "[\"HUM1\"]", "[]"),
        ("the same diagnosis twice", "[\"HUM1\"]", "[\"SON1\"]"),
        ("counts that do not add", "missed = 1", "missed = 2"),
        ("no count of the missed", "missed = 1\n", ""),
        ("a negative count", "missed = 1", "missed = -1"),
        ("a negative delay", "[900]", "[-900]"),
        ("a delay beyond the window", "[900]", "[120_001]"),
        ("a fraction", "[900]", "[0.9]"),
        ("no delay", "[900]", "[]"),
        ("no run", "runs = 4\nmissed = 4", "runs = 0\nmissed = 0"),
        ("too many seeds", "seeds = 4", "seeds = 10_001"),
        ("more false alarms than runs", "missed = 4", "missed = 4\nfalse_alarms = 5"),
        ("an unknown key", "missed = 4", "missed = 4\nnamed = 0"),
        ("no failure", "[[failure]]\nid", "[[failures]]\nid"),
    ];
    let mut told = String::new();
    for (what, from, to) in cases {
        let text = SOUND.replacen(from, to, if what == "no failure" { 2 } else { 1 });
        assert_ne!(text, SOUND, "{what}");
        let errors = Measurement::parse("measured.toml", &text, &robot()).unwrap_err();
        let _ = write!(told, "== {what}\n{errors}\n\n");
    }
    cotama_golden::compare("tests/golden/measurements.txt", &told);
}
