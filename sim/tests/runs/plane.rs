//! Missions in the plane beside the same missions on a line: what is decided, and what it costs.
#![allow(clippy::unwrap_used)]

use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{Moment, RobotFile};
use cotama_sim::options::{FaultChoice, Fidelity, Options};
use cotama_sim::robots::{Driven, Injection, Script};
use cotama_sim::run::Outcome;
use cotama_sim::story::points;
use cotama_sim::trace::{PlanRow, Record, Trace, replay};

fn mission(name: &str) -> Mission {
    let known = embedded::mission(name).unwrap();
    Mission::parse(known.name, known.text).unwrap()
}

fn supervised_patrol() -> Mission {
    let patrol = embedded::mission("patrol").unwrap();
    let robot = RobotFile::shipped("p3dx-patrol");
    Mission::parse_on(patrol.name, patrol.text, robot, None).unwrap()
}

fn record(mission: &Mission, fidelity: Fidelity) -> Trace {
    Trace::record(mission, &Options { fidelity, ..Options::default() }).unwrap().0
}

/// The points of the story of a run, without times.
fn told(trace: &Trace) -> Vec<(String, Option<String>)> {
    points(&trace.records).iter().map(|it| (it.title(), it.decided())).collect()
}

#[test]
fn the_delivery_in_the_plane_has_its_seven_points_and_decisions_in_their_order() {
    let delivery = mission("delivery");
    let [line, plane] = [Fidelity::Line, Fidelity::Plane].map(|it| record(&delivery, it));
    let words = |it: &Trace| -> Vec<String> {
        // Without the time from the failure to the decision.
        let decided = |it: Option<String>| it.map(|it| it.split_once(": ").unwrap().1.to_owned());
        told(it).into_iter().map(|(title, of)| format!("{title} {:?}", decided(of))).collect()
    };
    assert_eq!(words(&line), words(&plane));
    assert_eq!(points(&plane.records).len(), 7);
    let configurations = |it: &Trace| -> Vec<Option<String>> {
        let all = it.records.iter().filter_map(|it| match it {
            Record::Configuration(it) => Some(it.configuration.clone()),
            _ => None,
        });
        all.collect()
    };
    assert_eq!(configurations(&line), configurations(&plane));
}

#[test]
fn the_patrol_in_the_plane_has_the_plans_of_the_line_at_the_same_places() {
    let patrol = supervised_patrol();
    let row = |it: &PlanRow| (it.activity.clone(), it.choice.clone(), it.speed_mm_s);
    let plans = |fidelity| -> Vec<_> {
        let trace = record(&patrol, fidelity);
        let all = trace.records.iter().filter_map(|it| match it {
            Record::Plan(it) => {
                let rows: Vec<_> = it.plan.iter().map(row).collect();
                Some((it.x_mm / 1_000, it.cause.clone(), rows))
            }
            _ => None,
        });
        all.collect()
    };
    let [line, plane] = [Fidelity::Line, Fidelity::Plane].map(plans);
    assert_eq!(line, plane);
    assert_eq!(plane.iter().map(|it| it.0).collect::<Vec<_>>(), [0, 63, 118, 170]);
}

/// Braking before each goal; the robot of the shift is fast, and slows down before bends too.
#[test]
fn a_mission_in_the_plane_takes_longer_and_never_runs_against_anything() {
    for (mission, more_ms) in [(mission("delivery"), 600), (mission("shift"), 23_100)] {
        let run = |fidelity| {
            let options = Options { fidelity, faults: FaultChoice::None, ..Options::default() };
            Driven::with(&mission, &options).unwrap().run(&Script::default()).unwrap()
        };
        let [line, plane] = [Fidelity::Line, Fidelity::Plane].map(run);
        assert_eq!((plane.outcome, plane.touched), (Outcome::Completed, None));
        assert_eq!(plane.x, line.x);
        assert_eq!(plane.time.0 - line.time.0, more_ms, "{}", mission.name);
    }
}

#[test]
fn a_trace_in_the_plane_holds_poses_and_replays_to_the_record() {
    let patrol = supervised_patrol();
    let trace = record(&patrol, Fidelity::Plane);
    let read = Trace::parse("patrol.jsonl", &trace.to_json_lines()).unwrap();
    assert!(replay(&read).unwrap().identical);
    assert_eq!(read.header.floor.unwrap().source, "corridors");
    let count = |of: fn(&Record) -> bool| read.records.iter().filter(|it| of(it)).count();
    let poses = count(|it| matches!(it, Record::Pose(_)));
    assert_eq!(poses, count(|it| matches!(it, Record::Sample(_))) - 4); // one at each plan
}

/// Whole numbers of a run of many thousand steps: the same in debug and release, and on 32 bits.
#[test]
fn a_shift_in_the_plane_ends_at_the_same_place_on_every_machine() {
    let trace = record(&mission("shift"), Fidelity::Plane);
    let last = trace.records.iter().rev().find_map(|it| match it {
        Record::Pose(it) => Some((it.at_mm, it.heading_mrad, it.odometry_mm, it.odometry_mrad)),
        _ => None,
    });
    let Some(Record::End(end)) = trace.records.last() else { panic!("no end") };
    let used = (end.used.duration_ms, end.used.energy_mj);
    assert_eq!(
        (used, last.unwrap()),
        ((390_200, 38_208_230), ([24_337, 26_000], 0, [24_336, 26_003], 0))
    );
}

/// Wheels that are not as the robot knows them bend no path that is followed by a known pose.
#[test]
fn errors_of_wheels_mislead_odometry_alone() {
    let delivery = embedded::mission("delivery").unwrap();
    let robot = cotama_models::robots::embedded("p3dx-delivery").unwrap();
    let text = robot.text.replacen(
        "[body.motion_power]",
        "[body.wheels]\nleft_error_ppm = 10_000\n\n[body.motion_power]",
        1,
    );
    let robot = RobotFile::parse("own.toml", &text).unwrap();
    let mission = Mission::parse_on(delivery.name, delivery.text, Some(robot), None).unwrap();
    let options =
        Options { fidelity: Fidelity::Plane, faults: FaultChoice::None, ..Options::default() };
    let (trace, run) = Trace::record(&mission, &options).unwrap();
    assert_eq!(run.outcome, Outcome::Completed);
    let last = trace.records.iter().rev().find_map(|it| match it {
        Record::Pose(it) => Some(it.clone()),
        _ => None,
    });
    let last = last.unwrap();
    let off = |axis: usize| f64::from(last.at_mm[axis] - last.odometry_mm[axis]);
    assert!(off(0).abs() + off(1).abs() > 1_000.0, "{last:?}");
}

/// A robot with dead motors stands at once, one without commands after two seconds.
#[test]
fn failures_of_motion_mean_the_same_in_the_plane() {
    let delivery = mission("delivery");
    let robot = delivery.robot().unwrap().robot();
    for (id, most_mm) in [("MOT1", 20), ("COM3", 700)] {
        let Some(failure) = robot.failure(id) else { continue };
        let when = Moment::Place(Millimetres(10_000));
        let script =
            Script { injections: vec![Injection::new(when, failure)], ..Script::default() };
        let run = |fidelity| {
            let options = Options { fidelity, ..Options::default() };
            let driven = Driven::with(&delivery, &options).unwrap();
            driven.watched_for(Millis(60_000)).run(&script).unwrap()
        };
        let [line, plane] = [Fidelity::Line, Fidelity::Plane].map(run);
        assert_eq!(plane.outcome, line.outcome, "{id}");
        assert!(!plane.moved_when_safe);
        assert!(plane.x.0.abs_diff(line.x.0) <= most_mm, "{id}: {:?} {:?}", plane.x, line.x);
    }
}
