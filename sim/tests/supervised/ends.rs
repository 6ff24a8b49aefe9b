//! How runs end: what is kept to the last unit, how an emergency stop is driven, and that nothing
//! moves afterwards.

use super::delivery;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::FailureMode::{self, Bat2, Mot4, Odo1, Pwr1};
use cotama_models::missions::{Mission, embedded};
use cotama_sim::run::{Outcome, Reason};
use cotama_sim::supervised::{Injection, Run, Script, Supervised, When};

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
