//! `cotama conform`: whether a recorded run is a run of a model, and where it departs.

use crate::answers::conform::{AllowedRow, ConformAnswer, DepartsRow, MayFireRow, MayTellRow};
use crate::args::ConformArgs;
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::model::{self, Found};
use crate::names::{near, quoted};
use crate::output::Screen;
use crate::render;
use crate::robot;
use crate::simulate::not_played;
use crate::tree;
use cotama_core::units::Millis;
use cotama_models::missions::Mission;
use cotama_models::robots::RobotFile;
use cotama_sim::trace::{Record, Trace};
use cotama_verification::conform::{
    Departure, Line, Options, Recording, RecordingError, Refused, Verdict, What, conform as check,
};

/// The nets of a mission's trace whose firings it leaves out: they stand for the robot and for the
/// operator.
const SILENT: [&str; 2] = ["faults", OPERATOR];
const OPERATOR: &str = "operator";

/// Tells a model again what was recorded.
pub(crate) fn conform(args: &ConformArgs, screen: &Screen) -> Result<Exit, Failure> {
    if tree::is(&args.model.model) {
        return tree::conform(args, screen);
    }
    let option = args.tree.given().or(args.clock.then_some("--clock"));
    tree::idle(option, &args.model.model)?;
    if args.model.model == "-" && args.trace == "-" {
        return Err(Failure::new("standard input cannot hold both the model and the recorded run")
            .help("give the path of the model"));
    }
    let wanted = [Kind::Recording, Kind::Trace];
    let text = kind::text(&args.trace, "a recorded run", input::TRACE_BYTES, &wanted)?;
    let (recording, mission) = recorded(input::name(&args.trace), &text)?;
    let found = played(&args.model.model, mission.as_ref())?;
    let checked = model::with_found(&args.model.model, found, |it, labels| {
        let (tolerance, most_states) = (Millis(args.tolerance), args.max_states as usize);
        let (invisible, shared_names) = (&*labels.invisible, &*labels.shared);
        // A robot without an operator has no net that stands for him.
        let mut recording = recording.clone();
        let has = |name: &str| it.components.iter().any(|it| it.name == name);
        recording.silent.retain(|it| it != OPERATOR || has(it));
        check(it, &recording, Options { tolerance, most_states, invisible, shared_names })
    })?;
    let name = &args.model.model;
    let verdict = checked.map_err(|it| refused(it, name, input::name(&args.trace), &text))?;
    let answer = answer(name, &args.trace, &recording, verdict);
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::conform::screen(&answer, &text, screen.width()))?;
    }
    Ok(match answer.conforms {
        Some(true) => Exit::Success,
        Some(false) => Exit::Violated,
        None => Exit::Unknown,
    })
}

/// Returns the model of this name; of the robot of a recorded mission, its supervisors there.
fn played(name: &str, mission: Option<&Mission>) -> Result<Found, Failure> {
    let robot = mission.and_then(|it| it.robot()).map(RobotFile::robot);
    if let (Some(mission), Some(robot)) = (mission, robot)
        && robot::robot(name)?.as_ref() == Some(robot)
        && let Some(found) = Found::of_mission(mission)
    {
        return Ok(found);
    }
    model::find(name)
}

/// A recording, or the trace of a mission under supervisors, with the mission.
fn recorded(name: &str, text: &str) -> Result<(Recording, Option<Mission>), Failure> {
    let first = text.lines().find(|it| !it.trim().is_empty()).unwrap_or_default();
    if !first.contains("\"cotama-trace/1\"") {
        let read = Recording::read(name, text).map_err(|it| at_place(it, text));
        return read.map(|it| (it, None));
    }
    let trace = Trace::parse(name, text).map_err(|error| {
        let (line, column) = (error.line, error.column);
        FileErrors::at(name, text.to_owned(), line, column, error.message)
    })?;
    let mission = trace.header.mission().ok();
    let body = mission.as_ref().and_then(|it| it.robot()?.robot().body.as_ref());
    let recording = body.and_then(|it| of_mission(&trace, it.period)).ok_or_else(|| {
        Failure::new(format!(
            "{name}: no supervisors drove this mission, so no model can be held to it"
        ))
        .help("`cotama run delivery --trace delivery.jsonl` records one that they drive")
    })?;
    Ok((recording, mission))
}

/// Returns the recording of a mission's supervisors, if there are any: a round took place in each
/// period, and then they accepted one event. Within one period the trace lists first the firings.
fn of_mission(trace: &Trace, period: Millis) -> Option<Recording> {
    let said = |(number, record): (usize, &Record)| {
        let what = match record {
            Record::Told(it) => What::Event { name: it.event.clone(), ignored: Some(false) },
            Record::Fired(it) => What::Fired(format!("{}.{}", it.net, it.transition)),
            _ => return None,
        };
        Some(Line { number, column: 1, at: Millis(record.t_us() / 1_000), what })
    };
    // The header is the first line.
    let mut lines: Vec<_> = (2..).zip(&trace.records).filter_map(said).collect();
    lines.sort_by_key(|it| (it.at, matches!(it.what, What::Fired(_))));
    (!lines.is_empty()).then(|| Recording {
        start: Millis(0),
        round_every: Some(period),
        silent: SILENT.map(str::to_owned).to_vec(),
        lines,
        ..Recording::default()
    })
}

fn at_place(error: RecordingError, text: &str) -> Failure {
    let RecordingError { source_name, line, column, message, help } = error;
    FileErrors::at_character(&source_name, text.to_owned(), (line, column), message, help).into()
}

fn refused(refused: Refused, model: &str, trace: &str, text: &str) -> Failure {
    match refused {
        Refused::Model(why) => not_played(&why),
        Refused::Endless(at) => {
            Failure::new(format!("`{model}` does not come to rest at {} ms", at.0))
                .help("its transitions without event fire again and again; `settles` is a law")
        }
        Refused::Name { at: None, name, .. } if SILENT.contains(&name.as_str()) => {
            let message = format!(
                "this is the trace of a mission, and `{model}` is not the system of its supervisors"
            );
            let try_it = format!("try `cotama conform delivery {}`", quoted(trace));
            Failure::of(trace, message).help(try_it)
        }
        Refused::Name { at, kind, name, known } => {
            const SHOWN: usize = 12;
            let ending = format!(".{name}");
            let guess = known.iter().map(String::as_str).find(|it| it.ends_with(&ending));
            let guess = guess.or_else(|| near(&name, known.iter().map(String::as_str)));
            let guess = guess.map_or_else(String::new, |it| format!("; did you mean `{it}`?"));
            let shown: Vec<_> = known.iter().take(SHOWN).map(String::as_str).collect();
            let more = if known.len() > SHOWN { ", ..." } else { "" };
            let help = match kind {
                _ if known.is_empty() => format!("`{model}` has no {kind}s"),
                _ => format!("{kind}s of `{model}`: {}{more}", shown.join(", ")),
            };
            let message = format!("`{model}` has no {kind} `{name}`{guess}");
            at_place(
                RecordingError {
                    source_name: trace.to_owned(),
                    line: at.map_or(1, |it| it.0),
                    column: at.map_or(1, |it| it.1),
                    message,
                    help: Some(help),
                },
                text,
            )
        }
    }
}

fn answer(model: &str, trace: &str, recording: &Recording, verdict: Verdict) -> ConformAnswer {
    ConformAnswer {
        schema: "cotama/conform/1",
        model: model.to_owned(),
        trace: trace.to_owned(),
        conforms: verdict.unknown.is_none().then_some(verdict.departs.is_none()),
        lines: recording.lines.len() as u64,
        events: verdict.events,
        fired: verdict.fired,
        outputs: verdict.outputs,
        rounds: verdict.rounds,
        until_ms: verdict.until.0,
        departs: verdict.departs.map(departs),
        unknown_from: verdict.unknown.map(|it| it as u64),
    }
}

fn departs(Departure { line, at, reason, allowed }: Departure) -> DepartsRow {
    let fired = allowed.fired.into_iter().map(|it| MayFireRow {
        transition: it.transition,
        earliest_ms: it.earliest.0,
        latest_ms: it.latest.map(|it| it.0),
    });
    let events = allowed
        .events
        .into_iter()
        .map(|it| MayTellRow { event: it.event, transition: it.transition });
    let allowed = AllowedRow { fired: fired.collect(), events: events.collect() };
    DepartsRow { line: line as u64, time_ms: at.0, reason, allowed }
}
