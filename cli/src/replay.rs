//! `cotama replay`: a stored trace, or a file of faults, run again and compared.

use crate::answers::ReplayAnswer;
use crate::args::{ReplayArgs, STEPS};
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind};
use crate::mission::{self, Loaded};
use crate::names;
use crate::output::{self, Screen};
use crate::render;
use crate::run::{body, ended, refused, write_files};
use crate::words;
use cotama_models::missions::faults::Faults;
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::run::Run;
use cotama_sim::supervised::PLANNER;
use cotama_sim::trace::{self, Trace, TraceError};

/// Runs a trace or faults again and compares.
pub(crate) fn replay(args: &ReplayArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(path) = &args.trace {
        output::place(path)?;
    }
    if let Some(folder) = &args.report {
        output::report(folder)?;
    }
    let wanted = [Kind::Trace, Kind::Faults];
    let text = kind::text(&args.file, "a trace", input::TRACE_BYTES, &wanted)?;
    let (loaded, trace, run, identical) = if text.trim_start().starts_with('{') {
        again(&args.file, &text)?
    } else {
        twice(args, &text)?
    };
    let mut run_body = body(&trace, &run, &loaded.mission.name);
    write_files(args.report.as_deref(), args.trace.as_deref(), &trace, &mut run_body)?;
    let answer = ReplayAnswer { schema: "cotama/replay/1", identical, run: run_body };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let next = words::after_replay(args);
        let screen_text = render::run::screen(&answer.run, Some(&trace), next, screen.width());
        screen.print(&(screen_text + &render::run::identical(identical)))?;
    }
    Ok(if identical { ended(&run) } else { Exit::Violated })
}

type Again = (Loaded, Trace, Run, bool);

fn again(name: &str, text: &str) -> Result<Again, Failure> {
    let stored =
        Trace::parse(name, text).map_err(|TraceError { line, column, message, .. }| {
            FileErrors::at(input::name(name), text.to_owned(), line, column, message)
                .help("a trace is written by `cotama run MISSION --trace FILE.jsonl`")
        })?;
    let mission = stored.mission()?;
    let replayed = trace::replay(&stored).map_err(refused)?;
    let loaded = Loaded {
        source: stored.header.mission_source.clone(),
        text: stored.header.mission.clone(),
        mission,
    };
    Ok((loaded, replayed.trace, replayed.run, replayed.identical))
}

fn twice(args: &ReplayArgs, text: &str) -> Result<Again, Failure> {
    let Some(name) = &args.mission else {
        let message = "this is not a trace; a file of faults needs a mission";
        return Err(Failure::of(input::name(&args.file), message)
            .help(format!("cotama replay {} --mission patrol", names::quoted(&args.file))));
    };
    let loaded = mission::load(name)?;
    let faults = Faults::parse(&args.file, text, &loaded.mission)?;
    let faults = FaultChoice::Given { source: args.file.clone(), faults };
    let planner = if loaded.mission.supervisor().is_some() {
        PLANNER
    } else {
        mission::planner(mission::objective(None, None, &loaded.mission), None, STEPS)
    };
    let options = Options { seed: args.seed.unwrap_or(0), faults, planner, ..Options::default() };
    let run = || Trace::record(&loaded.source, &loaded.text, &options).map_err(refused);
    let ((first, run), (second, _)) = (run()?, run()?);
    let identical = first == second;
    Ok((loaded, first, run, identical))
}
