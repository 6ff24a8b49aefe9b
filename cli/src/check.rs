//! `cotama check`: whether properties of a model hold, and why.

pub(crate) mod contest;
pub(crate) mod explained;
mod files;
mod junit;
mod limit;
pub(crate) mod questions;
pub(crate) mod sarif;
mod uri;
mod watch;

use crate::answers::check::{
    Amount, CheckAnswer, EvidenceName, Infinite, Interrupted, ResponseRow, ResultRow, VerdictName,
};
use crate::args::{CheckArgs, EngineName};
use crate::budget::Budget;
use crate::exit::{Exit, Failure};
use crate::last_word::LastWord;
use crate::model;
use crate::output::{self, Screen};
use crate::progress::Progress;
use crate::render::style::NAME;
use crate::render::{self, visible};
use crate::subject::{Subject, Unmade};
use crate::tree;
use cotama_verification::certificate::Evidence;
use cotama_verification::check::{Answer, Checker, Choice, Extent, Options, Reason, Verdict};
use cotama_verification::diagnosis::Diagnosis;
use cotama_verification::explicit::Limit;
use cotama_verification::property::{Property, Question, mcc};
use cotama_verification::tpn::Time;
use files::Files;
use std::time::Instant;

/// Answers all questions to a model; with `--watch` again whenever a file changes.
pub(crate) fn check(args: &CheckArgs, screen: &Screen) -> Result<Exit, Failure> {
    if tree::is(&args.model) {
        return tree::check::check(args, screen);
    }
    tree::idle(args.tree.given().or(args.wishes.given()), &args.model)?;
    let last_word = LastWord::new(args.json.json);
    if !args.watch {
        return once(args, screen, &last_word);
    }
    let files = watch::files(args)?;
    loop {
        let before = watch::stamps(&files);
        if let Err(failure) = once(args, screen, &last_word) {
            last_word.forget();
            screen.refuse(&failure, args.json.json);
        }
        screen.note("watching; Ctrl-C ends it");
        watch::until_changed(&files, &before);
    }
}

fn once(args: &CheckArgs, screen: &Screen, last_word: &LastWord) -> Result<Exit, Failure> {
    // Reading is part of the work.
    let budget = Budget::start(args.budget);
    let engine = engine(args.engine)?;
    let mut files = Files::new(args)?;
    if let Some(too_large) = limit::of(args)? {
        return limit::told(args, &too_large, screen);
    }
    let found = match &args.mission {
        Some(mission) => model::of_robot(&args.model, mission)?,
        None => model::find(&args.model)?,
    };
    let subject = match Subject::of(&args.model, found, args.untimed, args.semantics) {
        Ok(subject) => subject,
        Err(Unmade::Failure(failure)) => return Err(failure),
        Err(Unmade::TooLarge(it)) => return limit::told(args, &(*it).into(), screen),
    };
    let asked = questions::asked(args, &subject)?;
    if let Some(it) = asked
        .properties
        .iter()
        .find(|it| args.mcc && matches!(it.question, Question::Response { .. }))
    {
        return Err(Failure::new(format!(
            "the contest has no form for the time that `{}` asks for",
            it.name
        ))
        .help("leave --mcc out"));
    }
    let subject = if asked.are_laws { subject.without_time() } else { subject };
    files.of = asked.properties.len();
    let progress = Progress::new();
    let mut texts = Vec::new();
    last_word.begin(CheckAnswer {
        schema: "cotama/check/1",
        model: subject.name.clone(),
        timed: subject.is_timed(),
        time_unit: subject.time_unit(),
        semantics: subject.semantics,
        notes: subject.notes.clone(),
        left_out: asked.left_out.clone(),
        // Whoever reads it before all is answered is told so.
        interrupted: Some(Interrupted { asked: asked.properties.len() }),
        results: Vec::new(),
    });
    // A person sees each verdict when it is known.
    let shows = !args.json.json && !args.mcc;
    if shows {
        let (name, timed, width) = (&subject.name, subject.is_timed(), screen.width());
        screen.print(&render::check::head(name, timed, &subject.notes, width))?;
    }
    let plain = Checker::new(&subject.model);
    let mut shares = budget.among(asked.properties.len());
    for (position, property) in asked.properties.iter().enumerate() {
        let watched = asked.watched.get(position).and_then(Option::as_ref);
        let requirement = asked.requirements.get(position);
        let budget = shares.next();
        progress.begin(position + 1, asked.properties.len(), &property.name);
        let show = |it| progress.show(it);
        let options = Options {
            engine,
            engines: &[],
            limits: budget.limits,
            jobs: budget.jobs,
            evidence: args.certificate.is_some() || requirement.is_some(),
            progress: &show,
        };
        let begun = Instant::now();
        let own = watched.map(|it| match &it.rounds {
            Some(rounds) => plain.watched(&it.model, rounds.watching(), &options),
            None => Checker::new(&it.model),
        });
        let (subject, checker) = (watched.unwrap_or(&subject), own.as_ref().unwrap_or(&plain));
        let found = checker.answer(property, &options);
        let seconds = begun.elapsed().as_secs_f64();
        progress.clear();
        if args.mcc {
            Screen::raw((line(property, &found, budget.jobs) + "\n").as_bytes())?;
        }
        let mut row = row(subject, property, &found, engine, seconds);
        (row.id, row.sentence) = requirement.map(|it| (it.id.clone(), it.sentence.clone())).unzip();
        row.certificate = files.certificate(position, subject, property, &found, screen)?;
        let mut text = None;
        match explained::diagnosis(subject, property, &found) {
            Some(Ok(diagnosis)) => {
                files.trace(position, &diagnosis, screen)?;
                row.explained_by(subject, &diagnosis, &found);
                text = Some(match &subject.rounds {
                    Some(rounds) => explained::in_rounds(rounds, &diagnosis, &found),
                    // The text is indented by two.
                    None => {
                        format!("{diagnosis:.width$}", width = screen.width().saturating_sub(2))
                    }
                });
            }
            Some(Err(error)) => {
                screen.note(&format!(
                    "the run for {} cannot be shown: {error}",
                    visible(&property.name)
                ));
            }
            None => match explained::unused(checker, property, &found, &options) {
                Some(unused) => {
                    files.unused(position, subject, &unused, screen)?;
                    row.unused = Some(explained::unused_row(&unused));
                    text = Some(unused.to_string());
                }
                None => files.no_trace(property, screen),
            },
        }
        // Requirements name cells that are never reached on purpose.
        if !args.mcc && requirement.is_none() {
            let vacuous = explained::vacuity(checker, subject, property, &found, &options);
            progress.clear();
            match vacuous {
                explained::Vacuous::Because(reason) => row.vacuous = Some(reason),
                explained::Vacuous::Not => {}
                explained::Vacuous::Unsettled => screen.note(&format!(
                    "{}: whether it holds vacuously was tried for some of its parts only",
                    visible(&property.name)
                )),
            }
        }
        if shows {
            let (unit, width) = (subject.time_unit(), screen.width());
            screen.print(&render::check::result(&row, asked.is_usual, unit, width))?;
        }
        texts.push(text.filter(|_| !asked.is_usual || row.verdict == VerdictName::False));
        last_word.add(row, position + 1 < asked.properties.len());
    }
    let mut answer = last_word.take_or_end();
    answer.interrupted = None;
    for (file, text) in [(&args.junit, junit::text(&answer)), (&args.sarif, sarif::text(&answer))] {
        if let Some(path) = file {
            output::file(path, text.as_bytes())?;
            screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
        }
    }
    if args.json.json {
        Screen::json(&answer)?;
    } else if shows {
        screen.print(&render::check::reasons(&answer, &texts, screen.width()))?;
    }
    Ok(ended(&answer.results))
}

fn engine(name: EngineName) -> Result<Choice, Failure> {
    Ok(match name {
        EngineName::Auto => Choice::Auto,
        EngineName::Explicit => Choice::Explicit,
        EngineName::Stubborn => Choice::Stubborn,
        EngineName::Structural => Choice::Structural,
        EngineName::Symbolic | EngineName::Sat => {
            let name = if name == EngineName::Sat { "sat" } else { "symbolic" };
            return Err(Failure::new(format!("the engine `{name}` is not in this version"))
                .help("engines: auto, explicit, stubborn, structural"));
        }
    })
}

fn ended(results: &[ResultRow]) -> Exit {
    let any = |verdict| results.iter().any(|it| it.verdict == verdict);
    match (any(VerdictName::False), any(VerdictName::Unknown)) {
        (true, _) => Exit::Violated,
        (false, true) => Exit::Unknown,
        (false, false) => Exit::Success,
    }
}

fn row(
    subject: &Subject,
    property: &Property,
    answer: &Answer,
    engine: Choice,
    seconds: f64,
) -> ResultRow {
    let pt = subject.model.pt();
    let (mut bound, mut response) = (None, None);
    let (verdict, reason) = match answer.verdict {
        Verdict::Holds(true) => (VerdictName::True, None),
        Verdict::Holds(false) => (VerdictName::False, None),
        Verdict::Bound(most) => {
            bound = Some(match most {
                Extent::Finite(most) => Amount::Finite(most),
                Extent::Infinite => Amount::Infinite(Infinite::Inf),
            });
            (VerdictName::True, None)
        }
        Verdict::Response(times) => {
            let [min, max] = [times.map(|it| amount(it.0)), times.map(|it| amount(it.1))];
            response = Some(ResponseRow { min, max });
            (VerdictName::True, None)
        }
        Verdict::Unknown(reason) => (VerdictName::Unknown, Some(reason)),
    };
    let way_out = reason.map(|reason| match reason {
        Reason::Limit(Limit::States) => "--max-states allows more",
        Reason::Limit(Limit::Bytes) => "--max-memory allows more",
        Reason::Limit(Limit::Time) => "--max-seconds allows more",
        _ if engine != Choice::Auto => "--engine auto asks the others too",
        _ => reason.way_out(&property.question, subject.is_timed()),
    });
    ResultRow {
        name: property.name.clone(),
        id: None,
        sentence: None,
        property: property.question.display(pt).to_string(),
        verdict,
        reason: reason.map(|it| it.to_string()),
        way_out,
        bound,
        response,
        engine: answer.engine().to_owned(),
        techniques: answer.techniques.iter().map(|&it| it.to_owned()).collect(),
        states: answer.states,
        evidence: evidence(&answer.evidence),
        certificate: None,
        seconds,
        vacuous: None,
        cause: None,
        trace: None,
        rest: None,
        unused: None,
    }
}

impl ResultRow {
    fn explained_by(&mut self, subject: &Subject, diagnosis: &Diagnosis, answer: &Answer) {
        let shown = explained::shown(subject, answer, diagnosis.trace.len());
        self.cause = Some(diagnosis.cause.clone()).filter(|it| !it.is_empty());
        self.trace = Some(explained::firings(diagnosis, &shown));
        self.rest = Some(explained::rest(diagnosis, &shown));
    }
}

fn amount(time: Time) -> Amount {
    match time {
        Time::Finite(time) => Amount::Finite(time),
        Time::Infinite => Amount::Infinite(Infinite::Inf),
    }
}

fn evidence(evidence: &Evidence) -> EvidenceName {
    match evidence {
        Evidence::None => EvidenceName::None,
        Evidence::State => EvidenceName::State,
        Evidence::Each(_) => EvidenceName::Parts,
        Evidence::One(one) => self::evidence(&one.by),
        Evidence::Trace(_) => EvidenceName::Trace,
        Evidence::Lasso(_) => EvidenceName::Lasso,
        Evidence::Refutation(_) => EvidenceName::Refutation,
        Evidence::Graph(_) => EvidenceName::Graph,
        Evidence::Growth(_) => EvidenceName::Growth,
    }
}

/// The contest's line for an answer.
fn line(property: &Property, answer: &Answer, jobs: usize) -> String {
    let techniques = contest::techniques(&answer.techniques, jobs);
    let said = match answer.verdict {
        Verdict::Holds(holds) => mcc::Answer::Verdict(holds),
        Verdict::Bound(Extent::Finite(most)) => mcc::Answer::Bound(most),
        Verdict::Bound(Extent::Infinite) => {
            let (name, by) = (mcc::word(&property.name), techniques.join(" "));
            return format!("FORMULA {name} +inf TECHNIQUES {by}");
        }
        Verdict::Response(_) | Verdict::Unknown(_) => mcc::Answer::Unknown,
    };
    mcc::answer(&property.name, said, &techniques)
}

/// Why a search met fewer markings than there are, in words.
pub(crate) fn limit_in_words(limit: Limit) -> String {
    Reason::Limit(limit).to_string()
}
