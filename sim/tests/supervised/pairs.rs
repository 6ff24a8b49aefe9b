//! Two failures, each after each, at three moments: who moves too long without a module that it
//! requires, what nobody detects, and what is completed by luck.

use super::{delivery, golden};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Diagnosis, FailureMode, Modules, is_detectable, local, undetectable};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Answer;
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Answers, Conduct, Injection, Run, Script, Supervised, When};
use std::collections::BTreeMap;
use std::fmt::Write;

/// When the second one happens; the first one is at 5 m of the first drive.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Moment {
    Together,
    Later,
    OperatorDrives,
}

const MOMENTS: [Moment; 3] = [Moment::Together, Moment::Later, Moment::OperatorDrives];

impl Moment {
    const fn words(self) -> &'static str {
        match self {
            Self::Together => "together",
            Self::Later => "15 m later",
            Self::OperatorDrives => "while the operator drives",
        }
    }
}

/// An error of a run, as far as it is the second failure's.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Wrong {
    /// The robot moved without a module that it requires for longer than the bound.
    Exposed,
    /// Nobody detected it, though it is detected alone.
    Undetected,
    /// The mission was completed while a required module was broken, and nobody knew.
    Luck,
}

impl Wrong {
    const fn words(self) -> &'static str {
        match self {
            Self::Exposed => "moves too long without a required module",
            Self::Undetected => "undetected, and alone it is not",
            Self::Luck => "completed by luck",
        }
    }
}

fn script(first: FailureMode, second: Option<FailureMode>, moment: Moment) -> Script {
    let at = |x| When::Place(Millimetres(x));
    let when = match moment {
        Moment::Together => at(5_000),
        Moment::Later => at(20_000),
        Moment::OperatorDrives => When::During(local::State::Teleoperated, Millis(1_500)),
    };
    let asks =
        (moment == Moment::OperatorDrives).then(|| Injection::new(at(12_000), FailureMode::Mot3));
    let injections = [Injection::new(at(5_000), first)].into_iter();
    let injections =
        injections.chain(asks).chain(second.map(|it| Injection::new(when, it))).collect();
    let drives = Answers {
        x: Millimetres(0),
        answers: vec![Answer::Teleoperate, Answer::Goal],
        delay: Millis(8_000),
    };
    let answers = if asks.is_some() { vec![drives; 4] } else { Vec::new() };
    Script { injections, answers }
}

/// How long the robot may move without a module: until its failure is detected, decided and
/// answered, and until it stands.
fn bound(mode: FailureMode) -> u64 {
    u64::from(mode.rule().latency_ms).max(2_000) + 2 * 100 + 1_000
}

fn wrong(run: &Run, it: &Conduct, alone: bool) -> Option<Wrong> {
    let found = it.detected.is_some_and(|it| it.1 != Diagnosis::None);
    if it.exposed.0 > bound(it.mode) {
        return Some(Wrong::Exposed);
    }
    if !found && it.exposed.0 > 0 && run.outcome == Outcome::Completed {
        return Some(Wrong::Luck);
    }
    let in_time = run.time.0 > it.injected.0 + bound(it.mode);
    (!found && alone && in_time).then_some(Wrong::Undetected)
}

/// Why the second failure went wrong, by what the first one takes.
fn why(first: FailureMode, run: &Run, it: &Conduct) -> String {
    let lost = first.health(Modules::NONE);
    let left = lost.available();
    match it.detected {
        Some((_, Diagnosis::Unique(mode))) if mode != it.mode => "taken for another row".into(),
        Some((_, Diagnosis::Ambiguous(_) | Diagnosis::Unexplained)) => {
            "not told apart, and the answer came too late".into()
        }
        Some((_, Diagnosis::None)) => "its observers are lost".into(),
        Some(_) => "answered too late".into(),
        None if !is_detectable(it.mode, left) => {
            let watch = Modules::ALL.without(left);
            format!("{} takes its observers or what they look at ({watch})", first.name())
        }
        None if run.outcome == Outcome::Safe => "the robot stops before it shows".into(),
        None if it.exposed.0 > 0 => {
            "it does not show while the robot waits for the operator".into()
        }
        None => "what it is about does not run any more: no harm".into(),
    }
}

type Found = BTreeMap<(Wrong, String), Vec<String>>;

fn all(mission: &Mission) -> (usize, Found) {
    let supervised = Supervised::new(mission).unwrap();
    let run = |first, second, moment| supervised.run(&script(first, second, moment)).unwrap();
    let silent = undetectable(Modules::ALL);
    let modes = || FailureMode::ALL.iter().copied().filter(|it| !silent.has(*it));
    // Detection alone, at each moment: beside a failure that costs nothing.
    let harmless = FailureMode::Rt2;
    let detected = |run: &Run, mode| {
        let it = run.conduct.iter().rfind(|it| it.mode == mode);
        it.is_some_and(|it| it.detected.is_some_and(|it| it.1 != Diagnosis::None))
    };
    let alone: BTreeMap<_, _> = modes()
        .flat_map(|mode| MOMENTS.map(|moment| (mode, moment)))
        .map(|(mode, at)| ((mode, at), detected(&run(harmless, Some(mode), at), mode)))
        .collect();
    let (mut runs, mut found) = (0, Found::new());
    for first in FailureMode::ALL.iter().copied() {
        for second in FailureMode::ALL.iter().copied() {
            for moment in MOMENTS {
                let run = run(first, Some(second), moment);
                runs += 1;
                assert!(!run.moved_when_safe, "{first:?} {second:?} {moment:?}");
                let Some(it) = run.conduct.get(1..).and_then(|it| it.last()) else { continue };
                let known = alone.get(&(second, moment)).copied().unwrap_or(false);
                if it.mode != second || silent.has(second) {
                    continue; // it never happened, or nothing can see it
                }
                if let Some(what) = wrong(&run, it, known) {
                    let pair = format!("{}+{} {}", first.name(), second.name(), moment.words());
                    found.entry((what, why(first, &run, it))).or_default().push(pair);
                }
            }
        }
    }
    (runs, found)
}

#[test]
#[ignore = "a minute: CI runs it"]
fn every_pair_at_three_moments() {
    let (runs, found) = all(&delivery());
    let mut text = format!("{runs} runs of two failures\n");
    for ((what, why), pairs) in &found {
        writeln!(text, "\n{}: {why}: {} runs", what.words(), pairs.len()).unwrap();
        pairs.iter().for_each(|it| writeln!(text, "  {it}").unwrap());
    }
    golden("pairs.txt", &text);
}
