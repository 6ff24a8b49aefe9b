//! People whom a mission names: they hold its robot up, and it drives into nobody.
#![allow(clippy::unwrap_used)]
#![allow(clippy::cast_precision_loss)] // lengths of a robot

use cotama_core::units::{MillimetresPerSecond, Millis};
use cotama_floor::{Ground, Needs, embedded::OFFICE};
use cotama_models::missions::{Asked, Mission, MissionErrors};
use cotama_models::robots::RobotFile;
use cotama_plane::{Course, Rover};
use cotama_sim::options::{FaultChoice, Fidelity, Options};
use cotama_sim::run::Outcome;
use cotama_sim::trace::{Record, Trace, replay};
use proptest::prelude::*;
use std::sync::LazyLock;

/// A round of the Pioneer over the office, with people.
fn read(people: &str) -> Result<Mission, MissionErrors> {
    parsed(&format!("{}{people}", include_str!("common/rounds.toml")))
}

fn parsed(text: &str) -> Result<Mission, MissionErrors> {
    let robot = RobotFile::shipped("p3dx-delivery").unwrap();
    let radius = robot.robot().body.as_ref().unwrap().radius.0;
    let needs = Needs { radius_m: radius as f64 / 1_000.0, ..Needs::default() };
    let office = OFFICE.floor().unwrap();
    let asked = Asked::of(text).unwrap();
    let way = Ground::Drawing(&office).way("office", OFFICE.text, asked, needs);
    Mission::parse_on("rounds.toml", text, Some(robot), Some(&way))
}

fn ran(people: &str, fidelity: Fidelity) -> (Trace, Outcome, u64) {
    let options = Options { faults: FaultChoice::None, fidelity, ..Options::default() };
    let (trace, run) = Trace::record(&read(people).unwrap(), &options).unwrap();
    (trace, run.outcome, run.used[0])
}

/// The store lies on the way to the office.
const IN_THE_STORE: &str = "[[person]]\nid = \"Anna\"\nwalks = [\"store\", \"kitchen\"]\n";

#[test]
fn a_robot_waits_for_a_person_in_its_way_until_the_person_goes_on() {
    let stays = |ms: u64, gives_way: bool| {
        let more = format!("from_ms = {ms}\nspeed_mm_s = 1_000\nstays_ms = 600_000\n");
        let more = format!("{IN_THE_STORE}{more}gives_way = {gives_way}\n");
        let (_, outcome, used) = ran(&more, Fidelity::Plane);
        assert_eq!(outcome, Outcome::Completed);
        used
    };
    let alone = ran("", Fidelity::Plane).2;
    assert_eq!(stays(0, false), alone, "gone before the robot comes");
    let [patient, stubborn] = [true, false].map(|it| stays(60_000, it));
    assert!(alone < patient && patient < stubborn, "{alone} {patient} {stubborn}");
}

#[test]
fn a_line_has_no_people() {
    let [alone, together] = ["", IN_THE_STORE].map(|it| ran(it, Fidelity::Line));
    assert_eq!((alone.1, alone.2), (together.1, together.2));
}

#[test]
fn people_who_are_drawn_and_those_who_are_named_walk_again_from_a_trace() {
    let text = read(&format!("{IN_THE_STORE}from_ms = 9_000\n")).unwrap().text().to_owned();
    let text = text.replacen("floor =", "people = 3\nfloor =", 1);
    let options = Options {
        faults: FaultChoice::None,
        seed: 4,
        fidelity: Fidelity::Plane,
        ..Options::default()
    };
    let (trace, _) = Trace::record(&parsed(&text).unwrap(), &options).unwrap();
    let people = trace.records.iter().find_map(|it| match it {
        Record::Pose(it) => Some(it.people_mm.clone()),
        _ => None,
    });
    let people = people.unwrap();
    assert_eq!((people.len(), people.last()), (4, Some(&[8_000, 6_000])));
    let read = Trace::parse("rounds.jsonl", &trace.to_json_lines()).unwrap();
    assert!(replay(&read).unwrap().identical);
}

#[test]
fn a_person_whom_no_floor_holds_is_refused_where_it_is_named() {
    let person = |walks: &str| format!("[[person]]\nid = \"Anna\"\nwalks = {walks}\n");
    let said = [
        person("[\"kitchn\", \"store\"]"),
        person("[\"40000,500\"]"),
        person("[\"8000,900\", \"lab\"]"),
        person("[\"lab\", \"office D\"]"),
        person("[\"15000,10\"]"),
        person("[\"lab\", \"lab\"]"),
        person("[\"lab\"]\nspeed_mm_s = 20"),
        person("[\"lab\"]") + &person("[\"store\"]"),
    ];
    let said = said.map(|it| read(&it).unwrap_err().to_string().lines().next().unwrap().to_owned());
    let expected = [
        "rounds.toml:43:10: unknown place `kitchn`; did you mean `kitchen`?",
        "rounds.toml:43:10: the place `40000,500` is not on the floor",
        "rounds.toml:43:10: a person at `8000,900` stands where the robot starts: 200 mm away, and \
         both need 510 mm",
        "rounds.toml:43:17: nothing leads from `lab` to `office D` for this person",
        "rounds.toml:43:10: a person of 250 mm radius has no room at `15000,10`: 10 mm are free",
        "rounds.toml:43:17: this person walks from `lab` to `lab`",
        "rounds.toml:44:14: `speed_mm_s` must be 100 to 10000, not `20`",
        "rounds.toml:45:6: the person `Anna` is defined twice",
    ];
    assert_eq!(said, expected);
}

static ALONE: LazyLock<Course> = LazyLock::new(|| Course::of(&read("").unwrap(), 0).unwrap());

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]
    #[test]
    fn a_robot_drives_into_nobody_who_stands_still(
        part in 0.05..1.0_f64,
        aside in -0.4..0.4_f64,
        speed in 100..1_200_u64,
    ) {
        let track = ALONE.track();
        let there = track.pose(0, part * track.length()) * cotama_floor::Point::new(0.0, aside);
        let at = format!("{:.0},{:.0}", there.x * 1_000.0, there.y * 1_000.0);
        let Ok(mission) = read(&format!("[[person]]\nid = \"Anna\"\nwalks = [\"{at}\"]\n")) else {
            return Ok(()); // beside a wall, or where the robot starts
        };
        let course = Course::of(&mission, 0).unwrap();
        let mut rover = Rover::new(&course, 0);
        for _ in 0..1_500 {
            rover.go(MillimetresPerSecond(speed), mission.path_length, Millis(100));
            prop_assert!(!rover.touches(), "{at} at {:?}", rover.pose());
        }
    }
}
