//! The transport robot on its floor, and the patrol robot, by the signals of lasers, marks and a
//! gyro.
#![allow(clippy::unwrap_used)]
#![allow(clippy::cast_precision_loss)] // lengths of a robot

use cotama_core::units::Millimetres;
use cotama_floor::{Ground, Needs, embedded::CLINIC};
use cotama_models::missions::{Asked, Mission, embedded};
use cotama_models::robots::{Moment, RobotFile};
use cotama_sim::options::{FaultChoice, Fidelity, Options};
use cotama_sim::robots::{Driven, Script};
use cotama_sim::run::Outcome;
use cotama_sim::story::{Point, points};
use cotama_sim::trace::{Trace, replay};
use std::sync::LazyLock;

/// The mission `shift` over the clinic.
static WARD: LazyLock<Mission> = LazyLock::new(|| {
    let text = embedded::mission("ward").unwrap().text;
    let robot = RobotFile::shipped("transport").unwrap();
    let body = robot.robot().body.as_ref().unwrap();
    let needs = Needs { radius_m: body.radius.0 as f64 / 1_000.0, ..Needs::default() };
    let clinic = CLINIC.floor().unwrap();
    let way = Ground::Drawing(&clinic).way("clinic", CLINIC.text, Asked::of(text).unwrap(), needs);
    Mission::parse_on("ward.toml", text, Some(robot), Some(&way)).unwrap()
});

fn by_signals(seed: u64) -> Options {
    Options { seed, faults: FaultChoice::None, fidelity: Fidelity::Signal, ..Options::default() }
}

fn found(trace: &Trace) -> Vec<String> {
    points(&trace.records).iter().filter_map(Point::found).collect()
}

#[test]
fn the_shift_over_the_clinic_is_the_shift_on_its_line() {
    let shift = embedded::mission("shift").unwrap();
    let shift = Mission::parse(shift.name, shift.text).unwrap();
    let ran = [&shift, &*WARD].map(|it| {
        let run = Trace::record(it, &Options::default()).unwrap().1;
        (run.outcome, run.used, run.operator_requests)
    });
    assert_eq!(ran[0].0, Outcome::Completed);
    assert_eq!(ran[0], ran[1]);
}

#[test]
fn a_robot_with_lasers_completes_its_shift_without_a_false_alarm() {
    for seed in 0..3 {
        let run = Driven::with(&WARD, &by_signals(seed)).unwrap().run(&Script::default()).unwrap();
        let ended = (run.outcome, run.alarms.len(), run.touched, run.conduct.len());
        assert_eq!(ended, (Outcome::Completed, 0, None, 0), "{seed}");
    }
}

/// The camera hangs, foil blocks a wheel, scans match the map no more: all by signals.
#[test]
fn the_incidents_of_the_shift_arise_by_signals_and_a_trace_of_them_replays() {
    let options = Options { fidelity: Fidelity::Signal, ..Options::default() };
    let (trace, run) = Trace::record(&WARD, &options).unwrap();
    assert_eq!(run.outcome, Outcome::Completed);
    let expected = [
        "after 1.5 s, depth_late: it is CAM1",
        "after 0.2 s, wheel_blocked: it is WHL1",
        "after 2.6 s, poor_match: it is LOC1",
    ];
    assert_eq!(found(&trace), expected);
    let read = Trace::parse("ward.jsonl", &trace.to_json_lines()).unwrap();
    assert!(replay(&read).unwrap().identical);
}

/// Failures after 40 m, on the straight way along the south corridor.
#[test]
fn failures_of_lasers_camera_and_gyro_are_named_by_their_signals() {
    let driven = Driven::with(&WARD, &by_signals(0)).unwrap();
    let robot = WARD.robot().unwrap().robot();
    let named = ["LID1", "SCN1", "CAM1", "IMU1", "LNK1"].map(|id| {
        let row = robot.failure(id).unwrap();
        let it = driven.measure(row, Moment::Place(Millimetres(40_000)), 0..2).unwrap();
        (id, it.named(row), it.false_alarms)
    });
    assert_eq!(named, ["LID1", "SCN1", "CAM1", "IMU1", "LNK1"].map(|id| (id, 2, 0)));
}

/// PANORAMA tells its robot at 118 m that a laser is lost; here its scans stop.
#[test]
fn the_front_laser_of_the_patrol_is_found_lost_by_its_silence() {
    let patrol = embedded::mission("patrol").unwrap();
    let robot = RobotFile::shipped("p3dx-patrol").unwrap();
    let patrol = Mission::parse_under(patrol.name, patrol.text, Some(robot)).unwrap();
    let options = Options { fidelity: Fidelity::Signal, ..Options::default() };
    let trace = Trace::record(&patrol, &options).unwrap().0;
    assert_eq!(found(&trace)[0], "after 0.7 s, front scan late: it is LAS1");
}
