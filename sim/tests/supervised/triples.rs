//! Three failures at once, drawn at random.

use super::delivery;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Diagnosis, FailureMode, Module, local};
use cotama_models::missions::Mission;
use cotama_sim::run::Outcome;
use cotama_sim::streams::{Stream, Streams};
use cotama_sim::supervised::{
    Conduct, Effect, Injection, Motion, Run, Script, Supervised, When, effect,
};
use std::collections::BTreeMap;

fn one<T: Copy>(stream: &mut Stream, of: &[T]) -> T {
    of[stream.below(of.len() as u64) as usize]
}

fn injection(stream: &mut Stream) -> Injection {
    let places = [
        local::State::Planning,
        local::State::Following,
        local::State::HandOver,
        local::State::Teleprogrammed,
        local::State::Teleoperated,
    ];
    let when = match stream.below(3) {
        0 => When::At(Millis(stream.below(400_000))),
        1 => When::Place(Millimetres(stream.below(80_000))),
        _ => When::During(one(stream, &places), Millis(stream.below(20_000))),
    };
    let mode = one(stream, FailureMode::ALL);
    Injection { part: one(stream, Module::ALL), ..Injection::new(when, mode) }
}

/// What must hold of every run, whatever fails; whether the robot also stopped in time.
fn judge(run: &Run, script: &Script) -> bool {
    assert!(!run.moved_when_safe, "M1: {script:?}");
    let runs_away =
        |it: &Injection| matches!(effect(it.mode), Effect { motion: Motion::Runaway, .. });
    if !script.injections.iter().any(runs_away) {
        assert!(run.braked <= Millimetres(150), "M2: {} after {script:?}", run.braked);
    }
    // What is done too late or with too much energy is done all the same.
    assert!(
        run.outcome != Outcome::Failed || run.x == Millimetres(80_000),
        "stuck after {script:?}"
    );
    // Each loss alone: detected, two rounds, and standing still; they may follow each other.
    let each =
        script.injections.iter().map(|it| u64::from(it.mode.rule().latency_ms).max(2_000) + 1_200);
    run.exposed.0 <= each.sum() || {
        // But for what several failures at once hide: no diagnosis, or not of this one alone.
        let found = |it: &Conduct| match it.detected {
            Some((_, Diagnosis::Unique(mode))) => mode == it.mode,
            _ => false,
        };
        assert!(!run.conduct.iter().all(found), "AS2: {} after {script:?}", run.exposed);
        false
    }
}

fn campaign(mission: &Mission, runs: u64) -> BTreeMap<(Outcome, bool), u64> {
    let supervised = Supervised::new(mission).unwrap();
    let mut outcomes = BTreeMap::new();
    for seed in 0..runs {
        let mut stream = Streams::new(seed).stream("triple");
        let injections = (0..3).map(|_| injection(&mut stream)).collect();
        let script = Script { injections, answers: Vec::new() };
        let run = supervised.run(&script).unwrap();
        let in_time = judge(&run, &script);
        *outcomes.entry((run.outcome, in_time)).or_default() += 1;
    }
    outcomes
}

#[test]
fn three_failures_never_leave_the_robot_moving() {
    let expected = BTreeMap::from([
        ((Outcome::Completed, true), 487),
        ((Outcome::Completed, false), 1), // one failure hides another one
        ((Outcome::Safe, true), 510),
        ((Outcome::Failed, true), 2), // too late
    ]);
    assert_eq!(campaign(&delivery(), 1_000), expected);
}

/// A hundred thousand: `cargo test --release -p cotama-sim --test supervised -- --ignored
/// --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn a_hundred_thousand_triples() {
    let outcomes = campaign(&delivery(), 100_000);
    println!("{outcomes:?}");
    assert_eq!(outcomes.values().sum::<u64>(), 100_000);
}
