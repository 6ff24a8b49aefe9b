//! Why a verdict is as it is: by a run, or that it holds for a reason that is none.

use crate::answers::check::{ChangeRow, FiringRow, NeverRow, RestRow, UnusedRow};
use crate::render::visible;
use crate::subject::Subject;
use cotama_verification::check::{Answer, Checker, Options, Verdict};
use cotama_verification::diagnosis::{Case, Diagnosis, Never, NotARun, Step, Unused, vacuous};
use cotama_verification::explicit::Limits;
use cotama_verification::flat::{Part, Rounds};
use cotama_verification::property::{Formula, Property, Question};
use std::fmt::Write;

/// Budget of finding out whether a property holds vacuously: so many questions, each among so many
/// markings.
const QUESTIONS: usize = 8;
const MARKINGS: u64 = 100_000;

/// Among so many markings it is looked for all that no run uses, where the verdict did not need
/// them all.
const UNUSED: u64 = 1_000_000;

/// The run of an answer, explained, if there is one.
pub(crate) fn diagnosis(
    subject: &Subject,
    property: &Property,
    answer: &Answer,
) -> Option<Result<Diagnosis, NotARun>> {
    let run = answer.run.as_ref()?;
    let case = Case {
        schedule: answer.schedule.as_ref(),
        ..Case::new(subject.model.pt(), property, answer.verdict != Verdict::Holds(false), run)
    };
    let view = subject.net.as_ref().map(|it| it.view());
    let net = view.as_ref().map(|it| it.net());
    let explained = Diagnosis::new(&Case { net: net.as_ref(), ..case });
    // The net of a file may have been changed before it was checked; then it explains nothing.
    Some(if explained == Err(NotARun::Net) { Diagnosis::new(&case) } else { explained })
}

/// Which firings of a run are shown: of a system in rounds not those in which its token only goes
/// on.
pub(crate) fn shown(subject: &Subject, answer: &Answer, count: usize) -> Vec<bool> {
    let (Some(rounds), Some(run)) = (&subject.rounds, &answer.run) else {
        return vec![true; count];
    };
    run.firings().map(|it| rounds.part(it) != Some(Part::Between)).collect()
}

/// A run of a system in rounds, as what happens in each of them.
pub(crate) fn in_rounds(rounds: &Rounds, diagnosis: &Diagnosis, answer: &Answer) -> String {
    let mut text = format!("{}\n", diagnosis.summary);
    let Some(run) = &answer.run else { return text };
    let firings: Vec<_> = run.firings().collect();
    for (round, number) in rounds.told(&firings).into_iter().zip(1..) {
        let outside = round.outside.map(|(event, fired)| match event {
            Some(event) => format!("from outside {event}: {fired}"),
            None => "nothing from outside".to_owned(),
        });
        let all: Vec<_> = round.turns.into_iter().chain(outside).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  round {number}  {}", visible(&all.join("; ")));
    }
    if run.cycle().is_some_and(|it| !it.is_empty()) {
        let before = rounds.told(&run.stem).len();
        let _ = writeln!(text, "  what follows round {before} repeats for ever");
    }
    text
}

/// The firings of a run that are shown, a loop once.
pub(crate) fn firings(diagnosis: &Diagnosis, shown: &[bool]) -> Vec<FiringRow> {
    let row = |step: &Step| FiringRow {
        transition: step.transition.clone(),
        event: step.event.clone(),
        outputs: step.outputs.clone(),
        time: step.at.map(|it| it.to_string()),
        changed: step
            .changes
            .iter()
            .map(|it| ChangeRow { place: it.place.clone(), before: it.before, after: it.after })
            .collect(),
    };
    diagnosis.trace.iter().zip(shown).filter(|it| *it.1).map(|it| row(it.0)).collect()
}

/// How a run goes on.
pub(crate) fn rest(diagnosis: &Diagnosis, shown: &[bool]) -> RestRow {
    match diagnosis.cycle_starts_at {
        Some(at) => RestRow::LoopFrom(shown.iter().take(at).filter(|it| **it).count() as u64),
        None if diagnosis.deadlock => RestRow::Deadlock,
        None => RestRow::Any,
    }
}

/// Returns the parts that no run uses, if a property is false because of it.
pub(super) fn unused<'m>(
    checker: &Checker<'m>,
    property: &Property,
    answer: &Answer,
    options: &Options<'_>,
) -> Option<Unused<'m>> {
    let asks = matches!(property.question, Question::QuasiLiveness | Question::Liveness);
    let limits = Limits { states: options.limits.states.min(UNUSED), ..options.limits };
    let options = Options { limits, ..*options };
    let asked = (asks && answer.verdict == Verdict::Holds(false)).then(|| checker.unused(&options));
    asked.filter(|it| !it.transitions.is_empty())
}

pub(super) fn unused_row(unused: &Unused<'_>) -> UnusedRow {
    let rows = |all: Vec<Never>| {
        all.into_iter().map(|it| NeverRow { name: it.name, why: it.why }).collect()
    };
    UnusedRow {
        transitions: rows(unused.never_fired()),
        places: rows(unused.never_marked()),
        is_complete: unused.is_complete,
    }
}

/// Returns the reason why a true property holds vacuously, if one is found with little effort.
pub(super) fn vacuity(
    checker: &Checker<'_>,
    subject: &Subject,
    property: &Property,
    answer: &Answer,
    options: &Options<'_>,
) -> Vacuous {
    let limits = Limits { states: options.limits.states.min(MARKINGS), ..options.limits };
    let options = Options { limits, evidence: false, ..*options };
    let holds = |question| {
        let asked = Property { name: String::new(), question };
        checker.answer(&asked, &options).verdict == Verdict::Holds(true)
    };
    let formula = match (&property.question, &answer.verdict) {
        (Question::Formula(formula), Verdict::Holds(true)) => formula,
        (Question::Fair(_, assumed), Verdict::Holds(true)) => {
            let never = Formula::All(Formula::Finally(Formula::FALSE.into()).into());
            let none = holds(Question::Fair(never, assumed.clone()));
            return if none {
                Vacuous::Because("no run is as it is assumed to be".to_owned())
            } else {
                Vacuous::Not
            };
        }
        _ => return Vacuous::Not,
    };
    let variants = vacuous(formula);
    let is_complete = variants.is_complete && variants.asked.len() <= QUESTIONS;
    let mut asked = variants.asked.into_iter().take(QUESTIONS);
    match asked.find(|stronger| holds(Question::Formula(stronger.formula.clone()))) {
        Some(found) => {
            let pt = subject.model.pt();
            Vacuous::Because(found.words(&property.question.display(pt).to_string(), pt))
        }
        None if is_complete => Vacuous::Not,
        None => Vacuous::Unsettled,
    }
}

/// Whether a property holds vacuously.
pub(super) enum Vacuous {
    /// For this reason.
    Because(String),
    /// No, or it was not found out among few markings.
    Not,
    /// The property has more parts than are asked about, and none of the parts asked is the reason.
    Unsettled,
}
