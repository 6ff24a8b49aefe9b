//! A door that closes on the way: the robot goes around it, or says why it cannot.
#![allow(clippy::unwrap_used)]
#![allow(clippy::cast_precision_loss)] // lengths of a robot

use cotama_floor::{Floor, Ground, Needs, embedded::OFFICE};
use cotama_models::missions::{Asked, Mission, MissionErrors};
use cotama_models::robots::RobotFile;
use cotama_sim::faults_text::faults_text;
use cotama_sim::options::{Fidelity, Options};
use cotama_sim::run::{Outcome, Run};
use cotama_sim::trace::{Occurrence, Record, Trace, replay};

/// Two rooms with two doors between them.
const ROOMS: &str = r#"
format = "cotama-floor/1"
name = "rooms"
size_mm = [12_000, 8_000]
wall = [
    { points_mm = [[0, 0], [12_000, 0], [12_000, 8_000], [0, 8_000], [0, 0]] },
    { points_mm = [[6_000, 0], [6_000, 1_500]] },
    { points_mm = [[6_000, 2_500], [6_000, 5_500]] },
    { points_mm = [[6_000, 6_500], [6_000, 8_000]] },
]
door = [
    { name = "south", hinge_mm = [6_000, 1_500], latch_mm = [6_000, 2_500], state = "open" },
    { name = "north", hinge_mm = [6_000, 6_500], latch_mm = [6_000, 5_500], state = "open" },
]
place = [
    { name = "start", at_mm = [1_500, 2_000] },
    { name = "right", at_mm = [10_000, 2_000] },
    { name = "left", at_mm = [3_000, 4_000] },
]
"#;

/// Rounds of the Pioneer over the two rooms, with what happens to doors.
fn rooms(events: &str) -> Mission {
    let text = include_str!("common/rounds.toml");
    let text = text.replace("office B", "right").replace("lab", "left").replace("dock", "start");
    let rooms = Floor::parse("rooms.toml", ROOMS).unwrap();
    over(&rooms, ROOMS, &format!("{text}{events}")).unwrap()
}

/// A round of the Pioneer over the office, with what happens to doors.
fn read(events: &str) -> Result<Mission, MissionErrors> {
    let text = format!("{}{events}", include_str!("common/rounds.toml"));
    over(&OFFICE.floor().unwrap(), OFFICE.text, &text)
}

fn over(floor: &Floor, of_floor: &str, text: &str) -> Result<Mission, MissionErrors> {
    let robot = RobotFile::shipped("p3dx-delivery").unwrap();
    let radius = robot.robot().body.as_ref().unwrap().radius.0;
    let needs = Needs { radius_m: radius as f64 / 1_000.0, ..Needs::default() };
    let way = Ground::Drawing(floor).way("floor", of_floor, Asked::of(text).unwrap(), needs);
    Mission::parse_on("rounds.toml", text, Some(robot), Some(&way))
}

fn becomes(door: &str, state: &str, when: &str) -> String {
    format!("[[run.event]]\n{when}\nkind = \"door\"\ndoor = \"{door}\"\nbecomes = \"{state}\"\n")
}

fn ran(mission: &Mission, fidelity: Fidelity) -> (Trace, Run) {
    Trace::record(mission, &Options { fidelity, ..Options::default() }).unwrap()
}

/// The detours of a run: which door, and how much longer the way is.
fn detours(trace: &Trace) -> Vec<(String, u64)> {
    let all = trace.records.iter().filter_map(|it| match it {
        Record::Event(it) => match &it.event {
            Occurrence::Detour { door, extra_mm } => Some((door.clone(), *extra_mm)),
            _ => None,
        },
        _ => None,
    });
    all.collect()
}

#[test]
fn a_robot_before_a_door_that_has_closed_goes_another_way() {
    let closes = becomes("south", "closed", "t_ms = 1_000");
    for fidelity in [Fidelity::Plane, Fidelity::Signal] {
        let [alone, closed] = ["", &closes].map(|it| ran(&rooms(it), fidelity));
        let found = detours(&closed.0);
        let ended = (closed.1.outcome, closed.1.reason, found.len());
        assert_eq!(ended, (Outcome::Completed, None, 1), "{fidelity:?}");
        assert_eq!(found[0].0, "south");
        let Record::End(end) = closed.0.records.last().unwrap() else { panic!("no end") };
        assert_eq!(end.x_mm, closed.0.header.path_length_mm);
        // There and back by the other door, at 0.3 m/s.
        let (extra_ms, late_ms) = (found[0].1 * 10 / 3, closed.1.used[0] - alone.1.used[0]);
        assert!(found[0].1 > 5_000, "{found:?}");
        assert!(late_ms > extra_ms && late_ms < extra_ms + 60_000, "{late_ms} {extra_ms}");
    }
}

/// The extra way is owed at once, so that margins are smaller by it, and the mission does not count
/// on before it is driven.
#[test]
fn a_detour_is_owed_when_it_is_known_and_driven_before_the_mission_counts_on() {
    let (trace, _) = ran(&rooms(&becomes("south", "closed", "t_ms = 1_000")), Fidelity::Plane);
    let (mut met, mut before, mut after) = (None, None, None);
    let mut stood = 0;
    for it in &trace.records {
        match it {
            Record::Event(it) => met = Some(it.x_mm),
            Record::Sample(it) => match met {
                None => before = Some(it.margins.duration_ms),
                Some(x_mm) => {
                    after = after.or(Some(it.margins.duration_ms));
                    stood += u64::from(it.x_mm == x_mm);
                }
            },
            _ => {}
        }
    }
    let (extra, lost) = (detours(&trace)[0].1, before.unwrap() - after.unwrap());
    assert!(lost * 3 / 10 > extra.cast_signed() * 9 / 10, "{lost} ms for {extra} mm");
    assert!(stood > 10, "{stood} s");
}

#[test]
fn a_robot_to_whose_goal_nothing_leads_any_more_stands_and_says_so() {
    let closes = becomes("door B", "closed", "t_ms = 5_000");
    let (trace, run) = ran(&read(&closes).unwrap(), Fidelity::Plane);
    let read = Trace::parse("rounds.jsonl", &trace.to_json_lines()).unwrap();
    assert!(replay(&read).unwrap().identical);
    let Record::End(end) = trace.records.last().unwrap() else { panic!("no end") };
    let reason = "nothing leads to `office B` any more: `door B` is closed";
    assert_eq!((run.outcome, end.reason.as_deref()), (Outcome::Safe, Some(reason)));
}

#[test]
fn a_door_that_opens_again_before_it_is_seen_is_as_if_it_had_been_open() {
    let events =
        becomes("door B", "closed", "t_ms = 1_000") + &becomes("door B", "open", "t_ms = 3_000");
    let [alone, both] = ["", &events].map(|it| ran(&read(it).unwrap(), Fidelity::Plane));
    assert_eq!(alone.1.used, both.1.used);
    assert_eq!(alone.0.records, both.0.records);
}

#[test]
fn a_line_has_no_doors() {
    let closed = becomes("door B", "closed", "during = \"Following\"\nafter_ms = 100");
    let [alone, closed] = ["", &closed].map(|it| ran(&read(it).unwrap(), Fidelity::Line));
    assert_eq!(alone.0.records, closed.0.records);
}

#[test]
fn doors_of_a_script_are_written_and_read_again() {
    let mission = read(&becomes("door B", "closed", "t_ms = 5_000")).unwrap();
    let text = faults_text(&mission.run.faults, &mission);
    let again = cotama_models::missions::faults::Faults::parse("script", &text, &mission).unwrap();
    assert_eq!(again, mission.run.faults);
}

#[test]
fn a_door_that_is_none_is_refused_where_it_is_named() {
    let said = [
        becomes("dor B", "closed", "t_ms = 5"),
        becomes("door B", "shut", "t_ms = 5"),
        becomes("door B", "open", ""),
        becomes("door B", "open", "x_mm = 99_000_000"),
    ];
    let said = said.map(|it| read(&it).unwrap_err().to_string().lines().next().unwrap().to_owned());
    let expected = [
        "rounds.toml:44:8: unknown door of the floor `dor B`; did you mean `door B`?",
        "rounds.toml:45:11: unknown state of a door `shut`",
        "rounds.toml:41:1: nothing says when this happens",
        "rounds.toml:42:8: the event at 99000000 mm lies behind the end of the path, 40748 mm",
    ];
    assert_eq!(said, expected);
}
