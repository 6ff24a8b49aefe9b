//! Every row of the FMECA, alone, in every place of the local supervisor.

use super::{delivery, golden};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Diagnosis, FailureMode, Module, local};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Answer;
use cotama_sim::body::{Motion, effect};
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Answers, Injection, Run, Script, Supervised, When};
use std::fmt::Write;

const PLACES: [local::State; 5] = [
    local::State::Planning,
    local::State::Following,
    local::State::HandOver,
    local::State::Teleoperated,
    local::State::Teleprogrammed,
];

/// The modules that may be the one of a failure of any module.
const PARTS: [Module; 9] = [
    Module::Mcl,
    Module::Smz,
    Module::Ust,
    Module::Nav,
    Module::Ppl,
    Module::Gui,
    Module::Dvz,
    Module::Lan,
    Module::Cam,
];

/// A run in which a row is injected half a second after a place is reached; an uncharted obstacle
/// brings the operator in. Drift beyond the corridor is a failure of the degraded set alone, which
/// runs when a sonar was lost before; a carpet edge brings the operator in there.
fn run(mission: &Mission, mode: FailureMode, part: Module, place: local::State) -> Run {
    let autonomous = matches!(place, local::State::Planning | local::State::Following);
    let degraded = mode == FailureMode::Loc3;
    let asks = if degraded { FailureMode::Mot3 } else { FailureMode::Loc2 };
    let asks = Injection::new(When::Place(Millimetres(6_000)), asks);
    let row = Injection { part, ..Injection::new(When::During(place, Millis(500)), mode) };
    let sonar = Injection::new(When::Place(Millimetres(500)), FailureMode::Son1);
    let before = degraded.then_some(sonar);
    let looks_and_edits = Answers {
        x: Millimetres(0),
        answers: vec![Answer::Teleoperate, Answer::Teleprogram, Answer::Path],
        delay: Millis(8_000),
    };
    let answers = if degraded { vec![looks_and_edits] } else { Vec::new() };
    let injections: Vec<_> =
        before.into_iter().chain((!autonomous).then_some(asks)).chain([row]).collect();
    Supervised::new(mission).unwrap().run(&Script { injections, answers }).unwrap()
}

/// How long the robot may move while a module is broken that it requires: until that is detected,
/// decided and answered, a round each. Before the drift of the degraded set it is the sonar's loss
/// that is to be detected. Without the laptop the micro-controller stops the robot after 2 s, and
/// that takes a second. A module that computes too long is broken from its next job on;
/// localisation that does is taken for one that lacks processor time, and loses particles twice
/// before it is left out.
fn bound(mode: FailureMode, part: Module) -> u64 {
    match mode {
        FailureMode::Rt3 if part == Module::Mcl => 1_400,
        FailureMode::Rt3 => 300 + 3 * 100,
        _ if effect(mode).motion == Motion::Mindless => 2_000 + 1_000,
        FailureMode::Loc3 => bound(FailureMode::Son1, part),
        _ => u64::from(mode.rule().latency_ms) + 2 * 100,
    }
}

fn line(run: &Run, mode: FailureMode, part: Module, place: local::State) -> String {
    let it = run.conduct.iter().rfind(|it| it.during == place && it.mode == mode).unwrap();
    let after = |at: Millis| at.0 - it.injected.0;
    let detected = it.detected.map_or("-".into(), |(at, diagnosis)| {
        let what = match diagnosis {
            Diagnosis::Unique(mode) => mode.name().to_owned(),
            Diagnosis::Ambiguous(modes) => format!("one of {modes}"),
            other => format!("{other:?}"),
        };
        format!("{} ms {what}", after(at))
    });
    let decided = it.decided.map_or("-".into(), |(at, what)| format!("{} ms {what:?}", after(at)));
    let answered = it.answered.map_or("-".into(), |at| format!("{} ms", after(at)));
    let part = if mode.rule().one_module { format!(" {}", part.name()) } else { String::new() };
    format!(
        "{}{part} | {place:?} | {detected} | {decided} | {answered} | {:?} after {} s, {} requests \
         | {} ms",
        mode.name(),
        run.outcome,
        run.time.0 / 1000,
        run.operator_requests,
        run.exposed.0
    )
}

/// 37 rows in five places, and the three of any module for nine modules: each run ends, none moves
/// when it is safe, and none moves for longer than the bound without a module that it requires.
#[test]
fn every_row_in_every_place() {
    let mission = delivery();
    let mut table = String::from(
        "row | place | detected | decided | answered | outcome | moved without a required module\n",
    );
    let (mut too_long, mut unseen) = (Vec::new(), Vec::new());
    for &mode in FailureMode::ALL {
        let parts = if mode.rule().one_module { &PARTS[..] } else { &PARTS[..1] };
        let mut exercised = mode.description().silent.is_some();
        for (&part, place) in parts.iter().flat_map(|part| PLACES.map(|place| (part, place))) {
            let run = run(&mission, mode, part, place);
            let line = line(&run, mode, part, place);
            let late = run.exposed.0 > bound(mode, part);
            if run.outcome == Outcome::Failed || run.moved_when_safe || late {
                too_long.push(line.clone());
            }
            exercised |= run.conduct.iter().any(|it| it.mode == mode && it.detected.is_some());
            writeln!(table, "{line}").unwrap();
        }
        unseen.extend((!exercised).then(|| mode.name()));
    }
    golden("fmeca_matrix.txt", &table);
    assert!(too_long.is_empty(), "{}", too_long.join("\n"));
    assert_eq!(unseen, [] as [&str; 0], "no run exercises these rows");
}
