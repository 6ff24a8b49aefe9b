//! Three failures at once, drawn at random.

use super::{delivery, golden};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Diagnosis, FailureMode, Module, local};
use cotama_models::missions::Mission;
use cotama_sim::body::{Effect, Motion, effect};
use cotama_sim::run::{LONGEST, Outcome};
use cotama_sim::streams::{Stream, Streams};
use cotama_sim::supervised::{Conduct, Fired, Injection, PERIOD, Run, Script, Supervised, When};
use cotama_sim::trace::Record;
use std::collections::BTreeMap;
use std::fmt::Write;

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

/// From 300 mm/s to standing.
const BRAKING: Millimetres = Millimetres(150);

fn runs_away(mode: FailureMode) -> bool {
    matches!(effect(mode), Effect { motion: Motion::Runaway, .. })
}

/// How far the robot went once the power of its motors was cut, if it was.
fn way_after_halt(supervised: &Supervised<'_>, run: &Run, script: &Script) -> Option<Millimetres> {
    let halted = |it: &&Fired| it.net == "gs" && it.transition.starts_with("abort.");
    // A round is taken at the end of its period.
    let at = run.fired.iter().find(halted)?.at.0 + PERIOD.0;
    let mut records: Vec<Record> = Vec::new();
    assert_eq!(&supervised.run_recorded(script, PERIOD, &mut records).unwrap(), run);
    let then = records.iter().find_map(|it| match it {
        Record::Sample(it) if it.t_us >= at * 1_000 => Some(it.x_mm),
        _ => None,
    });
    Some(Millimetres(run.x.0 - then.unwrap()))
}

/// Checks the requirements of every run, whatever fails, and how far the robot still goes in a
/// minute after its end; returns whether it also stopped in time.
fn judge(supervised: &Supervised<'_>, run: &Run, way: Millimetres, script: &Script) -> bool {
    assert!(!run.moved_when_safe, "M1: {script:?}");
    let may_run_away = script.injections.iter().any(|it| runs_away(it.mode));
    let ran_away = run.conduct.iter().any(|it| runs_away(it.mode));
    let was_ended = run.fired.iter().any(|it| it.net == "gs" && it.transition == "secured");
    // Motors that run away when the laptop is down are stopped by nobody.
    let is_down = run.outcome == Outcome::Safe && !was_ended;
    let stays = run.outcome == Outcome::Safe && !(is_down && may_run_away);
    assert!(!stays || way == Millimetres(0), "{way} after {script:?}");
    // They obey when their power is cut, not when they are told to stop.
    let halted = if ran_away { way_after_halt(supervised, run, script) } else { None };
    let braked = halted.unwrap_or(run.braked);
    assert!(
        braked <= BRAKING || (is_down && ran_away && halted.is_none()),
        "M2: {braked} after {script:?}"
    );
    // An objective done too late or with too much energy is done all the same, or the robot stands.
    assert!(
        run.outcome != Outcome::Failed || run.x == Millimetres(80_000) || run.time < LONGEST,
        "stuck after {script:?}"
    );
    is_in_time(run, script) || {
        // But for what several failures at once hide: no diagnosis, or not of this one alone.
        let found = |it: &Conduct| match it.detected {
            Some((_, Diagnosis::Unique(mode))) => mode == it.mode,
            _ => false,
        };
        assert!(!run.conduct.iter().all(found), "AS2: {} after {script:?}", run.exposed);
        false
    }
}

/// Each loss alone: detected, two rounds, and standing still; they may follow each other.
fn is_in_time(run: &Run, script: &Script) -> bool {
    let each =
        script.injections.iter().map(|it| u64::from(it.mode.rule().latency_ms).max(2_000) + 1_200);
    run.exposed.0 <= each.sum()
}

/// The failures of a run, in the order in which they happened; and what was found of the one whose
/// module was missed longest.
fn story(run: &Run) -> String {
    let names: Vec<_> = run.conduct.iter().map(|it| it.mode.name()).collect();
    let Some(late) = run.conduct.iter().max_by_key(|it| it.exposed) else { return String::new() };
    let found = match late.detected {
        None => "is not seen".to_owned(),
        Some((_, Diagnosis::Unique(mode))) if mode == late.mode => "is found".to_owned(),
        Some((_, Diagnosis::Unique(mode))) => format!("is taken for {}", mode.name()),
        Some((_, Diagnosis::Ambiguous(_))) => "is one of several".to_owned(),
        Some((_, Diagnosis::Unexplained)) => "is seen with others".to_owned(),
        Some((_, Diagnosis::None)) => "raises a flag that nobody explains".to_owned(),
    };
    format!("{}: {} {found}", names.join("+"), late.mode.name())
}

/// Which of the failures are late without the others: two of them, or only all three.
fn explained(supervised: &Supervised<'_>, script: &Script, run: &Run) -> String {
    let pairs = [[0, 1], [0, 2], [1, 2]].into_iter().filter_map(|pair| {
        let injections = pair.map(|it| script.injections[it]).to_vec();
        let script = Script { injections, answers: Vec::new() };
        let run = supervised.run(&script).unwrap();
        (!is_in_time(&run, &script)).then(|| story(&run))
    });
    let pairs: Vec<_> = pairs.collect();
    if pairs.is_empty() { format!("all three, {}", story(run)) } else { pairs.join(" / ") }
}

/// How many runs ended how, in time or not; and why those that were not.
type Campaign = (BTreeMap<(Outcome, bool), u64>, BTreeMap<String, u64>);

fn campaign(mission: &Mission, runs: u64) -> Campaign {
    let supervised = Supervised::new(mission).unwrap();
    let (mut outcomes, mut late) = (BTreeMap::new(), BTreeMap::new());
    for seed in 0..runs {
        let mut stream = Streams::new(seed).stream("triple");
        let injections = (0..3).map(|_| injection(&mut stream)).collect();
        let script = Script { injections, answers: Vec::new() };
        let (run, way) = supervised.run_and_watch(&script, Millis(60_000)).unwrap();
        let in_time = judge(&supervised, &run, way, &script);
        *outcomes.entry((run.outcome, in_time)).or_default() += 1;
        if !in_time {
            *late.entry(explained(&supervised, &script, &run)).or_default() += 1;
        }
    }
    (outcomes, late)
}

#[test]
fn three_failures_never_leave_the_robot_moving() {
    let expected = BTreeMap::from([
        ((Outcome::Completed, true), 480),
        ((Outcome::Safe, true), 517),
        ((Outcome::Failed, true), 3), // too late
    ]);
    assert_eq!(campaign(&delivery(), 1_000), (expected, BTreeMap::new()));
}

/// A hundred thousand: `cargo test --release -p cotama-sim --test supervised -- --ignored
/// --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn a_hundred_thousand_triples() {
    let (outcomes, late) = campaign(&delivery(), 100_000);
    assert_eq!(outcomes.values().sum::<u64>(), 100_000);
    let mut text = String::from("100000 runs of three failures\n\n");
    for ((outcome, in_time), count) in &outcomes {
        let time = if *in_time { "" } else { ", moved too long without a required module" };
        writeln!(text, "{count:6} {}{time}", outcome.name()).unwrap();
    }
    text += "\nWhich failures alone make it too long, and what becomes of the one that does:\n\n";
    let mut late: Vec<_> = late.into_iter().collect();
    late.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
    late.iter().for_each(|(why, count)| writeln!(text, "{count:6} {why}").unwrap());
    golden("triples.txt", &text);
}
