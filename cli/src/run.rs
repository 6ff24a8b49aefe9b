//! `cotama run`: a mission planned, run with its faults, planned again where needed, and reported.

use crate::answers::{Outcome, RunAnswer, RunBody};
use crate::args::{Fidelity, Lost, OperatorName, RunArgs};
use crate::axes;
use crate::exit::{Exit, Failure};
use crate::infeasible;
use crate::input;
use crate::kind::{self, Kind};
use crate::margins;
use crate::measurement;
use crate::mission;
use crate::names;
use crate::output::{self, Screen};
use crate::recording;
use crate::render;
use crate::render::numbers::count;
use crate::team::Chosen;
use crate::ways;
use crate::words;
use cotama_campaign::subject::Policy;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults, FaultsFile};
use cotama_models::robots::{Incident, IncidentKind};
use cotama_pages::mission as page;
use cotama_sim::options::{FaultChoice, Options, upward};
use cotama_sim::robots::{Script, Undriven};
use cotama_sim::run::{NoPlan, Reason, Run};
use cotama_sim::trace::{RecordError, Trace};
use std::path::{Path, PathBuf};

mod asked;
mod body;
mod situation;
mod supervised;
mod team;

pub(crate) use body::body;
pub(crate) use team::{replay as replay_team, replay_faults};

/// Plans a mission, runs it and reports.
pub(crate) fn run(args: &RunArgs, screen: &Screen) -> Result<Exit, Failure> {
    if args.mission.mission == ways::NAME_OF_ALL {
        return ways::run(args, screen);
    }
    ways::none_given(args)?;
    if let Some(path) = &args.trace {
        output::place(path)?;
    }
    if let Some(path) = &args.activities {
        output::place(path)?;
    }
    if let Some(folder) = &args.report {
        output::report(folder)?;
    }
    recording::places(&args.recording)?;
    if args.operator == OperatorName::Ask && args.mission.mission == "-" {
        let message = "--operator ask reads answers from standard input, where the mission is";
        return Err(Failure::new(message).help("give the mission as a file"));
    }
    if let Some(team) = Chosen::of(&args.mission.mission)? {
        return team::run(args, &team, screen);
    }
    if axes::is(&args.mission.mission) {
        return axes::run::run(args, screen);
    }
    team::none_given(args)?;
    team::not_meant(&args.mission.mission)?;
    mission::pursued(args.objective, args.planning.allocator)?;
    let remedy = "--fidelity plane drives it over its floor";
    recording::needs_plane(&args.recording, args.fidelity.into(), remedy)?;
    let mission = mission::load_for(&args.mission.mission, &args.planning, Some(screen))?;
    let options = options(args, &mission)?;
    let options = match args.operator {
        OperatorName::Script => options,
        OperatorName::Ask => asked::answered(&mission, options, screen)?,
    };
    if let Some(note) = planned_otherwise(args, &options, &mission) {
        screen.note(&note);
    }
    match (mission.is_supervised(), passed_over(&options.faults, &mission)) {
        (_, 0) => {}
        (false, number) => screen.note(&format!(
            "not simulated: {} for supervisors; the mission is run by its plans alone",
            count(number as u64, "event")
        )),
        (true, number) => screen.note(&format!(
            "not simulated: {} that only plans know; the mission is run by its supervisors",
            count(number as u64, "fault")
        )),
    }
    if let Some(note) = not_on_a_line(args, &options.faults, &mission) {
        screen.note(&note);
    }
    let (trace, run) = match Trace::record(&mission, &options) {
        Ok(recorded) => recorded,
        Err(RecordError::Infeasible { reason, text }) => {
            return never_left(args, screen, &mission, reason, text);
        }
        Err(error) => return Err(refused(error)),
    };
    let mut body = body(&trace, &run, &mission.name);
    if run.outcome == cotama_sim::run::Outcome::Safe
        && run.x_mm == 0
        && !args.planning.lost.is_empty()
    {
        let lost = mission::lost(&mission, &args.planning.lost)?;
        let available = mission::available(&mission, &lost);
        body.infeasible = infeasible::explain(&mission, mission.limits, available);
    }
    let report = args.report.clone().unwrap_or_else(|| default_folder(mission.source()));
    let report = (!args.no_report).then_some(report.as_path());
    write_files(report, args.trace.as_deref(), &trace, None, &mut body)?;
    if let Some(path) = &args.activities {
        let mut table = margins::Table::new();
        table.add(&mission, options.seed, &run.spent);
        table.write(path, screen)?;
    }
    body.recordings = recording::write(&args.recording, &trace)?;
    let answer = RunAnswer { schema: "cotama/run/1", run: body };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let next = next(args, &mission, &answer.run);
        screen.print(&render::run::screen(&answer.run, Some(&trace), next, screen.width()))?;
    }
    Ok(ended(&run))
}

/// Returns the hint that a file of faults records a failure of another planner.
fn planned_otherwise(args: &RunArgs, options: &Options, mission: &Mission) -> Option<String> {
    let text = input::text(&args.faults, "a file of faults", input::MISSION_BYTES);
    let text = text.ok().filter(|_| matches!(options.faults, FaultChoice::Given { .. }))?;
    let policy = Policy::from(&FaultsFile::parse(&args.faults, &text, mission).ok()?.planner?);
    let same = Some(policy.of(mission)) == options.planner
        && (policy.rigid, policy.upward) == (options.rigid, options.upward.is_some());
    (!same).then(|| {
        format!(
            "{} records a failure with another planner: {}; `cotama replay` runs it with that one",
            args.faults,
            policy.words(mission)
        )
    })
}

/// The command that suggests itself.
fn next(args: &RunArgs, mission: &Mission, body: &RunBody) -> Option<String> {
    if let Some(trace) = &body.trace {
        return Some(format!("cotama replay {}", names::quoted(trace)));
    }
    if args.operator == OperatorName::Ask {
        return None; // answers are no part of a command
    }
    let objective = mission::objective(args.objective, args.planning.allocator, mission);
    words::after_run(args, body, objective.name(), |args| helps(args, body))
}

/// Returns whether a run with these options is completed, or leaves where this one did not; the run
/// is made, and nothing of it is written.
fn helps(args: &RunArgs, body: &RunBody) -> bool {
    let made = || {
        let mission = mission::load_for(&args.mission.mission, &args.planning, None).ok()?;
        let options = options(args, &mission).ok()?;
        let (_, run) = Trace::record(&mission, &options).ok()?;
        let completed = run.outcome == cotama_sim::run::Outcome::Completed;
        Some(completed || body.x_mm == 0 && run.x_mm > 0)
    };
    made().unwrap_or(false)
}

/// The exit code of a run.
pub(crate) fn ended(run: &Run) -> Exit {
    match (run.outcome, run.reason) {
        (cotama_sim::run::Outcome::Completed, _) => Exit::Success,
        (_, Some(Reason::NoPlan(NoPlan::Unknown { .. }))) => Exit::Unknown,
        _ => Exit::Violated,
    }
}

/// A run that cannot be made.
pub(crate) fn refused(error: RecordError) -> Failure {
    match error {
        RecordError::Text(errors) => errors.into(),
        RecordError::Undriven(Undriven::Plain) => {
            let message = "only a robot with a file drives in the plane";
            Failure::new(message).help("--supervised ROBOT puts the mission under one")
        }
        RecordError::Setup(_) | RecordError::Undriven(_) => Failure::new(error.to_string()),
        RecordError::Infeasible { .. } => Failure::new(error.to_string())
            .help("`cotama plan MISSION` says what weighs most, and what would help"),
    }
}

/// There is no plan at the start: the robot stays where it is, and the mission is aborted.
fn never_left(
    args: &RunArgs,
    screen: &Screen,
    mission: &Mission,
    reason: NoPlan,
    text: String,
) -> Result<Exit, Failure> {
    let body = RunBody {
        mission: mission.name.clone(),
        seed: args.seed.unwrap_or(mission.run.seed),
        outcome: Outcome::Safe,
        reason: Some(text),
        infeasible: infeasible::explain(mission, mission.limits, mission.available()),
        plans: Vec::new(),
        replans: 0,
        operator_requests: 0,
        duration_margin_ms: None,
        energy_margin_mj: None,
        duration_ms: 0,
        energy_mj: 0,
        x_mm: 0,
        events: Vec::new(),
        supervised: None,
        held: None,
        report: None,
        trace: None,
        recordings: Vec::new(),
    };
    let answer = RunAnswer { schema: "cotama/run/1", run: body };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let next = next(args, mission, &answer.run);
        screen.print(&render::run::screen(&answer.run, None, next, screen.width()))?;
    }
    if args.report.is_some() || args.trace.is_some() || args.recording.first().is_some() {
        screen.note("nothing was run: no file is written");
    }
    Ok(if matches!(reason, NoPlan::Unknown { .. }) { Exit::Unknown } else { Exit::Violated })
}

fn options(args: &RunArgs, mission: &Mission) -> Result<Options, Failure> {
    if mission.is_supervised() && !args.planning.lost.is_empty() {
        let message = "--lost is for missions without supervisors";
        return Err(
            Failure::new(message).help("name a failure in a file of faults: kind = \"failure\"")
        );
    }
    if args.people > 0 && args.fidelity == Fidelity::Line {
        let message = "--people walk in the plane, and this run is on a line";
        return Err(Failure::new(message).help("add --fidelity plane"));
    }
    let allocator = args.planning.allocator;
    let given = [
        ("--objective", args.objective.is_some()),
        ("--allocator", allocator.is_some()),
        ("--upward", args.upward),
        ("--margins", margins::are_given(args.margins.as_deref())),
    ];
    mission::beside_wishes(mission, &given)?;
    let objective = mission::objective(args.objective, allocator, mission);
    let planner = mission::planner(objective, allocator, args.planning.steps)?;
    Ok(Options {
        seed: args.seed.unwrap_or(mission.run.seed),
        faults: faults(&args.faults, &args.planning.lost, mission)?,
        monitor_period: args.monitor_period.map(Millis),
        planner: Some(planner),
        rigid: false,
        upward: args.upward.then(|| upward(mission.limits)),
        fidelity: args.fidelity.into(),
        people: usize::try_from(args.people).unwrap_or(usize::MAX),
        measured: measurement::of_run(args.measured.as_deref(), mission, args.fidelity.into())?,
        margins: margins::of_run(args.margins.as_deref(), mission)?,
    })
}

/// Returns the faults of a run: those that were named, with hardware lost at the start.
fn faults(named: &str, lost: &[Lost], mission: &Mission) -> Result<FaultChoice, Failure> {
    let choice = match named {
        "script" => FaultChoice::Script,
        "none" => FaultChoice::None,
        path => {
            let (limit, wanted) = (input::MISSION_BYTES, [Kind::Faults]);
            let text = kind::text(path, "a file of faults", limit, &wanted)?;
            let file = FaultsFile::parse(path, &text, mission)?;
            FaultChoice::Given { source: path.into(), faults: file.faults }
        }
    };
    if lost.is_empty() {
        return Ok(choice);
    }
    let (source, mut faults) = match choice {
        FaultChoice::Script => ("script".to_owned(), mission.run.faults.clone()),
        FaultChoice::None => ("none".to_owned(), Faults::default()),
        FaultChoice::Given { source, faults } => (source, faults),
    };
    let kinds = mission::lost(mission, lost)?;
    let event =
        |(hardware, units)| Event { x: Millimetres(0), kind: EventKind::Fault { hardware, units } };
    faults.events.splice(0..0, kinds.into_iter().map(event));
    Ok(FaultChoice::Given { source: format!("{source}, hardware lost at the start"), faults })
}

/// Returns the hint that a line has no people and no doors.
fn not_on_a_line(args: &RunArgs, faults: &FaultChoice, mission: &Mission) -> Option<String> {
    let people = mission.people.drawn + mission.people.walkers.len();
    let is_door = |it: &&Incident| matches!(it.kind, IncidentKind::Door { .. });
    let doors = of_run(faults, mission).map_or(0, |it| it.of_robot.iter().filter(is_door).count());
    let people = match people {
        0 => None,
        1 => Some("1 person".to_owned()),
        more => Some(format!("{more} people")),
    };
    let doors = (doors > 0).then(|| count(doors as u64, "change of a door"));
    let what: Vec<_> = people.into_iter().chain(doors).collect();
    let is_told = args.fidelity == Fidelity::Line && !what.is_empty();
    is_told.then(|| {
        format!("not simulated on a line: {}; --fidelity plane has them", what.join(" and "))
    })
}

/// The faults of a run; none where it has none.
fn of_run<'f>(faults: &'f FaultChoice, mission: &'f Mission) -> Option<&'f Faults> {
    match faults {
        FaultChoice::None => None,
        FaultChoice::Script => Some(&mission.run.faults),
        FaultChoice::Given { faults, .. } => Some(faults),
    }
}

/// How many of the faults are passed over: those that only supervisors can deal with, in a run by
/// plans alone, and the others in one under supervisors.
fn passed_over(faults: &FaultChoice, mission: &Mission) -> usize {
    let Some(faults) = of_run(faults, mission) else { return 0 };
    if mission.is_supervised() { Script::passed_over(faults, mission) } else { 0 }
}

/// Writes the report and the trace where they are wanted, and notes it in the answer. `stored` is
/// the file of the trace, if the run was made from one.
pub(crate) fn write_files(
    folder: Option<&Path>,
    trace_file: Option<&Path>,
    trace: &Trace,
    stored: Option<&str>,
    body: &mut RunBody,
) -> Result<(), Failure> {
    if let Some(path) = trace_file {
        output::file(path, trace.to_json_lines().as_bytes())?;
        body.trace = Some(path.display().to_string());
    }
    if let Some(folder) = folder {
        output::make_folder(folder)?;
        let path = folder.join("index.html");
        let written = body.trace.as_deref().or(stored).map(names::quoted);
        output::file(&path, page::html_beside(trace, written.as_deref()).as_bytes())?;
        body.report = Some(path.display().to_string());
    }
    Ok(())
}

/// The folder of a report: `report/` and the name of the mission's source, without its folders and
/// its ending.
fn default_folder(source: &str) -> PathBuf {
    let stem = Path::new(source).file_stem().and_then(|stem| stem.to_str()).unwrap_or("mission");
    let safe = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '-' };
    Path::new("report").join(stem.chars().map(safe).collect::<String>())
}
