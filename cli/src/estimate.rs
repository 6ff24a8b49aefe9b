//! `cotama estimate`: how likely a random run of a model is as a property says.

use crate::answers::check::VerdictName;
use crate::answers::estimate::{EstimateAnswer, EstimateRow};
use crate::args::{EstimateArgs, MOST_RUNS};
use crate::check::{explained, questions};
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use crate::render::{self, visible};
use crate::subject::Subject;
use cotama_campaign::statistics::{clopper_pearson, okamoto_runs};
use cotama_sim::estimate::{Asked, Draw, Tally, Wants, Witness, draw, replay};
use cotama_verification::certificate::Evidence;
use cotama_verification::check::{Answer, Verdict};
use cotama_verification::property::Property;
use cotama_verification::temporal::{Rest, Run};
use std::time::Instant;

/// Draws runs and says what they show.
pub(crate) fn estimate(args: &EstimateArgs, screen: &Screen) -> Result<Exit, Failure> {
    let subject = Subject::load(&args.model, args.untimed, args.semantics)?;
    if subject.is_timed() {
        let message = "runs are drawn without time, and its transitions have intervals";
        return Err(Failure::of(&args.model, message).help("--untimed leaves the intervals out"));
    }
    if !subject.model.pt().is_plain() {
        let message = "runs are drawn of place/transition nets, and it has inhibitor arcs, reset \
            arcs or priorities";
        return Err(Failure::of(&args.model, message).help("`cotama check` knows what they mean"));
    }
    let properties = args.property.iter().map(|it| questions::one(it, false, &subject));
    let properties = properties.collect::<Result<Vec<_>, _>>()?;
    let asked = properties.iter().map(|it| asked(it, &subject)).collect::<Result<Vec<_>, _>>()?;
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    let runs = args.within.map_or(args.runs, |it| okamoto_runs(it, args.confidence));
    if runs > MOST_RUNS {
        let message = format!("that takes {runs} runs, and at most {MOST_RUNS} are drawn");
        return Err(Failure::new(message).help("a larger --within takes fewer"));
    }
    let all = Draw {
        runs,
        steps: args.steps,
        seed: args.seed,
        jobs: args.jobs.map_or_else(processors, |it| usize::try_from(it).unwrap_or(1)),
    };
    let begun = Instant::now();
    let drawn = draw(subject.model.pt(), &asked, all).map_err(|error| {
        Failure::of(&args.model, error.to_string()).help("fewer --steps come to fewer tokens")
    })?;
    let seconds = begun.elapsed().as_secs_f64();
    let (mut results, mut texts) = (Vec::new(), Vec::new());
    for ((property, asked), tally) in properties.iter().zip(&asked).zip(&drawn.tallies) {
        let (verdict, shown) = shown(asked.wants(), tally);
        let measured = clopper_pearson(tally.holding, drawn.runs, args.confidence);
        let mut row = EstimateRow {
            property: property.name.clone(),
            verdict,
            probability: measured.into(),
            holding: tally.holding,
            open: tally.open,
            run: shown.map(|it| it.run),
            cause: None,
            trace: None,
            rest: None,
        };
        texts.push(shown.and_then(|it| explain(&subject, property, &mut row, it, args, screen)));
        results.push(row);
    }
    let answer = EstimateAnswer {
        schema: "cotama/estimate/1",
        model: subject.name.clone(),
        semantics: subject.semantics,
        notes: subject.notes.clone(),
        runs: drawn.runs,
        steps: args.steps,
        seed: args.seed,
        results,
        fired: drawn.steps,
        seconds,
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::estimate::screen(&answer, &texts, screen.width()))?;
    }
    let any = |verdict| answer.results.iter().any(|it| it.verdict == verdict);
    Ok(match (any(VerdictName::False), any(VerdictName::Unknown)) {
        (true, _) => Exit::Violated,
        (false, true) => Exit::Unknown,
        (false, false) => Exit::Success,
    })
}

/// A property as runs are asked about it.
fn asked<'s>(property: &Property, subject: &'s Subject) -> Result<Asked<'s>, Failure> {
    let refused = |why: String| {
        Failure::new(format!("{}: {why}", visible(&property.name)))
            .help("`cotama check` answers it; runs are asked AG p, EF p, AF p, EG p, A (p U q)")
    };
    let formula = property
        .question
        .formula()
        .ok_or_else(|| refused("a single run cannot be held against it".to_owned()))?;
    if !matches!(property.question, cotama_verification::property::Question::Formula(_)) {
        return Err(refused("what is assumed of runs is no matter of chance".to_owned()));
    }
    Asked::new(formula, subject.model.pt()).map_err(|error| refused(error.to_string()))
}

/// Returns the verdict that a run shows for certain, if one does.
fn shown(wants: Wants, tally: &Tally) -> (VerdictName, Option<Witness>) {
    match (wants, tally.shortest_broken, tally.shortest_holding) {
        (Wants::All, Some(it), _) => (VerdictName::False, Some(it)),
        (Wants::Some, _, Some(it)) => (VerdictName::True, Some(it)),
        _ => (VerdictName::Unknown, None),
    }
}

/// The run that shows a verdict, explained as that of a check is.
fn explain(
    subject: &Subject,
    property: &Property,
    row: &mut EstimateRow,
    which: Witness,
    args: &EstimateArgs,
    screen: &Screen,
) -> Option<String> {
    let pt = subject.model.pt();
    let stem = replay(pt, args.seed, which);
    let last = stem.iter().try_fold(pt.initial.clone(), |marking, it| pt.fire(&marking, it.0))?;
    let is_dead = !(0..pt.transitions.len() as u32).any(|it| pt.enabled(&last, it));
    let rest = if is_dead { Rest::Stays } else { Rest::Any };
    let answer = Answer {
        verdict: Verdict::Holds(row.verdict == VerdictName::True),
        run: Some(Run { stem, rest }),
        schedule: None,
        evidence: Evidence::None,
        techniques: Vec::new(),
        states: 0,
    };
    let diagnosis = match explained::diagnosis(subject, property, &answer)? {
        Ok(diagnosis) => diagnosis,
        Err(error) => {
            let name = visible(&property.name);
            screen.note(&format!("the run for {name} cannot be shown: {error}"));
            return None;
        }
    };
    let shown = explained::shown(subject, &answer, diagnosis.trace.len());
    row.cause = Some(diagnosis.cause.clone()).filter(|it| !it.is_empty());
    row.trace = Some(explained::firings(&diagnosis, &shown));
    row.rest = Some(explained::rest(&diagnosis, &shown));
    Some(match &subject.rounds {
        Some(rounds) => explained::in_rounds(rounds, &diagnosis, &answer),
        None => format!("{diagnosis:.width$}", width = screen.width().saturating_sub(2)),
    })
}
