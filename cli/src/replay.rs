//! `cotama replay`: a stored trace, or a failure in a file of faults, run again and compared.

use crate::answers::{EndDifference, RecordDifference, RecordedFailure, ReplayAnswer};
use crate::args::ReplayArgs;
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::mission;
use crate::names;
use crate::output::{self, Screen};
use crate::recording;
use crate::render;
use crate::run::{body, ended, refused, replay_faults, replay_team, write_files};
use crate::words;
use cotama_campaign::recorded::{self, Again};
use cotama_campaign::subject::Policy;
use cotama_models::missions::Mission;
use cotama_models::missions::faults::FaultsFile;
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::run::Run;
use cotama_sim::trace::{self, Difference, Trace, TraceError};

/// Runs a trace or a failure again and compares.
pub(crate) fn replay(args: &ReplayArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(path) = &args.trace {
        output::place(path)?;
    }
    if let Some(folder) = &args.report {
        output::report(folder)?;
    }
    recording::places(&args.recording)?;
    let wanted = [Kind::Trace, Kind::Faults, Kind::TeamTrace, Kind::TeamFaults];
    let text = kind::text(&args.file, "a trace", input::TRACE_BYTES, &wanted)?;
    if kind::is_of(&text, Kind::TeamTrace) {
        return replay_team(args, &text, screen);
    }
    if kind::is_of(&text, Kind::TeamFaults) {
        return replay_faults(args, &text, screen);
    }
    let is_trace = text.trim_start().starts_with('{');
    let Replayed { mission, trace, run, compared } =
        if is_trace { stored(args, &text)? } else { faults(args, &text, screen)? };
    let remedy = "record it in the plane: cotama run MISSION --fidelity plane --trace FILE.jsonl";
    recording::needs_plane(&args.recording, trace.header.options.fidelity, remedy)?;
    let mut run_body = body(&trace, &run, &mission.name);
    let file = is_trace.then_some(args.file.as_str()).filter(|it| *it != "-");
    write_files(args.report.as_deref(), args.trace.as_deref(), &trace, file, &mut run_body)?;
    run_body.recordings = recording::write(&args.recording, &trace)?;
    let options = &trace.header.options;
    let (planner, upward, rigid) =
        (Some(options.allocator), options.upward.is_some(), options.rigid);
    let planner = Policy { planner, upward, rigid, ..Policy::default() }.words(&mission);
    let answer = answer(planner, &compared, run_body);
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let next = words::after_replay(args);
        let screen_text = render::run::screen(&answer.run, Some(&trace), next, screen.width());
        screen.print(&(screen_text + &render::run::compared(&answer)))?;
    }
    Ok(match (answer.returns, answer.identical) {
        (Some(true), _) => Exit::Success,
        (Some(false), _) | (None, Some(false)) => Exit::Violated,
        (None, _) => ended(&run),
    })
}

/// The run made again, and the one it was compared with.
struct Replayed {
    mission: Mission,
    trace: Trace,
    run: Run,
    compared: Compared,
}

enum Compared {
    /// With a trace, of which this record differs.
    Records(Option<Difference>),
    /// With a failure.
    Failure(Again),
    /// With nothing.
    Nothing,
}

fn answer(planner: String, compared: &Compared, run: crate::answers::RunBody) -> ReplayAnswer {
    let (mut identical, mut returns, mut difference, mut failure) = (None, None, None, None);
    match compared {
        Compared::Records(it) => {
            identical = Some(it.is_none());
            difference = it.as_ref().map(record_difference);
        }
        Compared::Failure(it) => {
            (identical, returns) = (Some(it.is_identical()), Some(it.returns()));
            failure = Some(recorded_failure(it));
        }
        Compared::Nothing => {}
    }
    let schema = "cotama/replay/1";
    ReplayAnswer { schema, identical, returns, planner, difference, failure, run }
}

pub(crate) fn record_difference(it: &Difference) -> RecordDifference {
    let field = it.field.as_ref();
    let whole = |there: bool| (field.is_none() && there).then(|| it.record.clone());
    RecordDifference {
        line: it.line as u64,
        record: it.record.clone(),
        field: field.map(|it| it.field.clone()),
        stored: field.map_or_else(|| whole(it.there[0]), |it| it.first.clone()),
        now: field.map_or_else(|| whole(it.there[1]), |it| it.second.clone()),
    }
}

pub(crate) fn recorded_failure(it: &Again) -> RecordedFailure {
    let [expected, found] = it.in_words();
    let differences = it.differences().into_iter().map(|(key, expected, found)| EndDifference {
        key: key.to_owned(),
        expected,
        found,
    });
    RecordedFailure {
        requirement: it.requirement.to_string(),
        broken: it.breaks,
        expected,
        found,
        differences: differences.collect(),
    }
}

fn stored(args: &ReplayArgs, text: &str) -> Result<Replayed, Failure> {
    let name = &args.file;
    let stored =
        Trace::parse(name, text).map_err(|TraceError { line, column, message, .. }| {
            FileErrors::at(input::name(name), text.to_owned(), line, column, message)
                .help("a trace is written by `cotama run MISSION --trace FILE.jsonl`")
        })?;
    let replayed = trace::replay(&stored).map_err(refused)?;
    let trace::Replayed { mission, trace, run, difference, .. } = replayed;
    Ok(Replayed { mission, trace, run, compared: Compared::Records(difference) })
}

fn faults(args: &ReplayArgs, text: &str, screen: &Screen) -> Result<Replayed, Failure> {
    let named = || FaultsFile::mission_of(text);
    let Some(name) = args.mission.clone().or_else(named) else {
        let message = "this is not a trace; a file of faults needs a mission";
        return Err(Failure::of(input::name(&args.file), message)
            .help(format!("cotama replay {} --mission patrol", names::quoted(&args.file))));
    };
    let robot = FaultsFile::robot_of(text);
    let mission = mission::loaded(&name, robot.as_deref(), Some(screen))?;
    let file = FaultsFile::parse(&args.file, text, &mission)?;
    let compared = match &file.expected {
        None => Compared::Nothing,
        Some(_) => Compared::Failure(
            recorded::again(&mission, &file)
                .map_err(|error| Failure::of(input::name(&args.file), error.to_string()))?,
        ),
    };
    let recorded = file.expected.as_ref().map_or(0, |it| it.seed);
    let policy = file.planner.as_ref().map_or_else(Policy::default, Policy::from);
    let faults = FaultChoice::Given { source: args.file.clone(), faults: file.faults };
    let options =
        Options { seed: args.seed.unwrap_or(recorded), ..policy.options(&mission, faults) };
    let (trace, run) = Trace::record(&mission, &options).map_err(refused)?;
    Ok(Replayed { mission, trace, run, compared })
}
