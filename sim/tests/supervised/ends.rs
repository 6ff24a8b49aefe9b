//! How runs end: what is kept to the last unit, how an emergency stop is driven, and that nothing
//! moves afterwards.

use super::delivery;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::FailureMode::{self, Bat2, Col1, Mot4, Odo1, Pwr1};
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_sim::run::{Outcome, Reason};
use cotama_sim::supervised::{Injection, PERIOD, Run, Script, Supervised, When};
use cotama_sim::trace::Record;

fn script(mode: FailureMode, x_mm: u64) -> Script {
    let injections = vec![Injection::new(When::Place(Millimetres(x_mm)), mode)];
    Script { injections, answers: Vec::new() }
}

fn run(mission: &Mission, script: &Script) -> Run {
    Supervised::new(mission).unwrap().run(script).unwrap()
}

/// Ticks stop at full speed: the mission is ended, and the permit taken back. From 300 mm/s it
/// takes a second and 150 mm.
#[test]
fn an_emergency_stop_takes_the_braking_distance() {
    let mission = delivery();
    let stopped = run(&mission, &script(Odo1, 5_000));
    let ended = stopped.fired.iter().find(|it| it.net == "gs" && it.transition == "abort.DriveA");
    assert_eq!((stopped.outcome, ended.is_some()), (Outcome::Safe, true));
    assert_eq!(stopped.braked, Millimetres(150));
    // The goal of each drive is reached at full speed, and the permit given back there.
    let whole = run(&mission, &Script::default());
    assert_eq!((whole.outcome, whole.braked), (Outcome::Completed, Millimetres(0)));
    // Motors without power stand at once.
    assert_eq!(run(&mission, &script(Bat2, 5_000)).braked, Millimetres(0));
}

#[test]
fn nothing_moves_for_a_minute_after_a_mission_was_ended() {
    let mission = delivery();
    let supervised = Supervised::new(&mission).unwrap();
    for mode in [Odo1, Bat2, Mot4, Pwr1] {
        let (run, way) = supervised.run_and_watch(&script(mode, 5_000), Millis(60_000)).unwrap();
        assert_eq!((run.outcome, way), (Outcome::Safe, Millimetres(0)), "{mode:?}");
        assert!(!run.moved_when_safe, "{mode:?}");
        assert_eq!(run, self::run(&mission, &script(mode, 5_000)), "to watch changes nothing");
    }
}

/// Somebody touches it for 5 s, and the laptop goes down after 4: when he is gone a second is left
/// in which the last command is obeyed.
#[test]
fn a_robot_held_up_when_the_laptop_goes_down_is_safe_once_the_micro_controller_stops_it() {
    let mission = delivery();
    let supervised = Supervised::new(&mission).unwrap();
    let held = script(Col1, 5_000);
    let since = run(&mission, &held).conduct[0].injected;
    let ends = |after: u64| {
        let down = Injection::new(When::At(Millis(since.0 + after)), Pwr1);
        let script = Script { injections: vec![held.injections[0], down], answers: Vec::new() };
        let (run, way) = supervised.run_and_watch(&script, Millis(60_000)).unwrap();
        assert_eq!((run.outcome, way), (Outcome::Safe, Millimetres(0)));
        (run.time.0 - since.0, run.x.0)
    };
    assert_eq!([1_000, 2_000, 3_000].map(ends), [(3_000, 5_010), (4_000, 5_010), (5_000, 5_010)]);
    // The robot speeds up for a second, to 150 mm/s, and stands half a second later.
    assert_eq!(ends(4_000), (6_500, 5_160));
}

/// The delivery with these limits.
fn within(duration_ms: u64, energy_mj: u64) -> Mission {
    let delivery = embedded::mission("delivery").unwrap();
    let text = delivery
        .text
        .replacen("duration_ms = 900000", &format!("duration_ms = {duration_ms}"), 1)
        .replacen("energy_mj = 7200000", &format!("energy_mj = {energy_mj}"), 1);
    let mission = Mission::parse(delivery.name, &text).unwrap();
    assert_eq!(mission.limits, [duration_ms, energy_mj]);
    mission
}

#[test]
fn a_delivery_that_just_keeps_its_limits_is_completed() {
    let [ms, mj] = run(&delivery(), &Script::default()).used;
    let kept = run(&within(ms, mj), &Script::default());
    assert_eq!((kept.outcome, kept.used), (Outcome::Completed, [ms, mj]));
    for (axis, mission) in [within(ms - 1, mj), within(ms, mj - 1)].into_iter().enumerate() {
        let passed = run(&mission, &Script::default());
        assert_eq!((passed.outcome, passed.used), (Outcome::Failed, [ms, mj]));
        let reason = passed.summary(&mission).reason;
        assert_eq!(reason, Some(Reason::LimitExceeded { axis, by: 1 }));
    }
}

/// Braking for the first goal costs the millisecond that is missing. While the robot stands nobody
/// can win it back: the operator is asked when it drives again.
#[test]
fn a_limit_that_cannot_be_kept_is_asked_about_when_it_drives() {
    let mission = delivery();
    let mut records: Vec<Record> = Vec::new();
    let supervised = Supervised::new(&mission).unwrap();
    supervised.run_recorded(&Script::default(), Millis(1_000), &mut records).unwrap();
    let margin = records.iter().find_map(|it| match it {
        Record::Sample(it) if it.t_us >= 150_000_000 => Some(it.margins.duration_ms),
        _ => None,
    });
    let limit = mission.limits[0] - margin.unwrap().unsigned_abs() - 1;
    let short = within(limit, mission.limits[1]);
    let asked = run(&short, &Script::default());
    // No period is passed over when samples are asked for.
    let supervised = Supervised::new(&short).unwrap();
    let each = supervised.run_recorded(&Script::default(), PERIOD, &mut Vec::new()).unwrap();
    assert_eq!(each, asked);
    let received = asked.fired.iter().find(|it| it.net == "gs" && it.transition == "g3").unwrap();
    let hard = asked.fired.iter().find(|it| it.net == "cs").unwrap();
    assert_eq!((received.at, hard.at), (Millis(166_200), Millis(167_100)));
    assert_eq!((asked.outcome, asked.operator_requests), (Outcome::Failed, 1));
}

/// Another program takes the processor: the pose is late three times, then it is made again, of
/// fewer particles, as soon as the supervisors have answered.
#[test]
fn a_late_pose_is_made_again_as_soon_as_it_is_answered() {
    assert_eq!(run(&delivery(), &script(FailureMode::Rt1, 3_000)).oldest_pose, Millis(820));
}

#[test]
fn each_repair_of_a_file_ends_the_last_failure_of_its_kind() {
    let mission = delivery();
    let event = |(x, kind): (u64, &str)| {
        format!("[[event]]\nx_mm = {x}\nkind = \"{kind}\"\nmode = \"SON2\"\n")
    };
    let events = [(5_000, "failure"), (10_000, "repair"), (15_000, "failure"), (20_000, "repair")];
    let text = format!("format = \"panorama-faults/1\"\n{}", events.map(event).concat());
    let script = Script::from(&Faults::parse("faults.toml", &text, &mission).unwrap());
    let spans: Vec<_> = script.injections.iter().map(|it| (it.when, it.until)).collect();
    let at = |mm| When::Place(Millimetres(mm));
    assert_eq!(spans, [(at(5_000), Some(at(10_000))), (at(15_000), Some(at(20_000)))]);
}
