//! Missions under a plan of faults, as their page plays them: from a file of faults, such as a
//! campaign's failure, from the trace of a run, or with the mission's own.

use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind as FileKind};
use crate::mission;
use crate::model::{self, Found};
use crate::names::quoted;
use crate::output::Screen;
use crate::run::refused;
use cotama_campaign::subject::Policy;
use cotama_core::units::Millis;
use cotama_models::missions::faults::{EventKind, Faults, FaultsFile};
use cotama_models::missions::{Definition, Mission};
use cotama_models::robots::{Incident, IncidentKind, Moment};
use cotama_playground::course::{Leg, Objective};
use cotama_playground::outing::{Item, Kind, Outing, world};
use cotama_sim::faults_text::faults_text;
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::robots::Script;
use cotama_sim::trace::{Record, Trace, TraceError};

/// A mission with what fails in it.
pub(super) struct Played {
    /// The supervisors of its robot.
    pub(super) found: Found,
    /// The name of the mission.
    pub(super) mission: String,
    pub(super) outing: Option<Outing>,
}

/// The mission and the faults that a name stands for; none where it stands for neither.
pub(super) fn of(
    name: &str,
    mission: Option<&str>,
    screen: &Screen,
) -> Result<Option<Played>, Failure> {
    if kind::is(name, FileKind::Faults) {
        return of_faults(name, mission, screen).map(Some);
    }
    if mission.is_some() {
        let message = format!("--mission: `{name}` is no file of faults");
        return Err(Failure::new(message).help("leave it out"));
    }
    if kind::is(name, FileKind::Trace) {
        return of_trace(name).map(Some);
    }
    let Some(mission) = model::mission_with_robot(name)? else { return Ok(None) };
    let Some(found) = Found::of_mission(&mission) else { return Ok(None) };
    // A mission without a plan, or one that is not simulated, has no courses.
    let trace = Trace::record(&mission, &Options::default()).ok();
    let of = format!("cotama run {} --faults", quoted(name));
    let outing = trace.and_then(|(trace, _)| {
        outing(&mission, &trace, &mission.run.faults, (&of, "the mission's own faults"))
    });
    Ok(Some(Played { found, mission: name.to_owned(), outing }))
}

/// A file of faults, of a mission that is given, or that it names as those of campaigns do.
fn of_faults(name: &str, of: Option<&str>, screen: &Screen) -> Result<Played, Failure> {
    let text = kind::text(name, "a file of faults", input::TRACE_BYTES, &[FileKind::Faults])?;
    let named = || FaultsFile::mission_of(&text);
    let Some(of) = of.map(str::to_owned).or_else(named) else {
        let message = "this file of faults does not say of which mission it is";
        return Err(Failure::of(input::name(name), message)
            .help(format!("cotama play {} --mission delivery", quoted(name))));
    };
    let robot = FaultsFile::robot_of(&text);
    let mission = mission::loaded(&of, robot.as_deref(), Some(screen))?;
    let found = supervised(name, &mission)?;
    let file = FaultsFile::parse(name, &text, &mission)?;
    let policy = file.planner.as_ref().map_or_else(Policy::default, Policy::from);
    let given = FaultChoice::Given { source: name.to_owned(), faults: file.faults.clone() };
    let seed = file.expected.as_ref().map_or(0, |it| it.seed);
    let options = Options { seed, ..policy.options(&mission, given) };
    let (trace, _) = Trace::record(&mission, &options).map_err(refused)?;
    let under = robot.map_or_else(String::new, |it| format!(" --supervised {}", quoted(&it)));
    let command = format!("cotama run {}{under} --faults", quoted(&of));
    let breaks = file.expected.as_ref().map(|it| format!(", which breaks `{}`", it.requirement));
    let from = format!("{name}{}", breaks.unwrap_or_default());
    let outing = outing(&mission, &trace, &file.faults, (&command, &from));
    Ok(Played { found, mission: of, outing })
}

/// The trace of a run, with the faults that it was run with.
fn of_trace(name: &str) -> Result<Played, Failure> {
    let text = kind::text(name, "a trace", input::TRACE_BYTES, &[FileKind::Trace])?;
    let trace =
        Trace::parse(name, &text).map_err(|TraceError { line, column, message, .. }| {
            FileErrors::at(input::name(name), text.clone(), line, column, message)
                .help("a trace is written by `cotama run MISSION --trace FILE.jsonl`")
        })?;
    let mission = trace.mission()?;
    let found = supervised(name, &mission)?;
    let options = trace.options(&mission)?;
    let faults = match options.faults {
        FaultChoice::Script => mission.run.faults.clone(),
        FaultChoice::None => Faults::default(),
        FaultChoice::Given { faults, .. } => faults,
    };
    let of = trace.header.mission_source.clone();
    let command = format!("cotama run {} --faults", quoted(&of));
    let outing = outing(&mission, &trace, &faults, (&command, &format!("the run in {name}")));
    Ok(Played { found, mission: of, outing })
}

fn supervised(name: &str, mission: &Mission) -> Result<Found, Failure> {
    Found::of_mission(mission).ok_or_else(|| {
        let message = format!("the mission {} has no robot, so no supervisors", mission.name);
        Failure::of(input::name(name), message)
            .help("`cotama replay` says what happens in it, and why")
    })
}

/// The data of a page of a mission, a run of it, and the faults of that run; none for a robot
/// without a body.
fn outing(
    mission: &Mission,
    trace: &Trace,
    faults: &Faults,
    (command, from): (&str, &str),
) -> Option<Outing> {
    let robot = mission.robot()?.robot();
    let (objectives, legs) = planned(mission, trace);
    let items = items(mission, trace, faults);
    let is_door = |it: &&Incident| matches!(it.kind, IncidentKind::Door { .. });
    let is_unit = |it: &EventKind| matches!(it, EventKind::Fault { .. });
    let rest = Faults {
        power_errors: faults.power_errors.clone(),
        events: faults.events.iter().filter(|it| !is_unit(&it.kind)).copied().collect(),
        random: faults.random.clone(),
        of_robot: faults.of_robot.iter().filter(is_door).cloned().collect(),
    };
    let floor = cotama_pages::mission::on_floor(trace);
    Some(Outing {
        world: world(robot, objectives, legs)?,
        items,
        unshown: unshown(&rest, mission),
        rest: faults_text(&rest, mission),
        command: command.to_owned(),
        limit_ms: mission.scenario().limits[0],
        from: from.to_owned(),
        floor,
    })
}

/// The objectives, and the speeds along the path, as they were planned at the start.
fn planned(mission: &Mission, trace: &Trace) -> (Vec<Objective>, Vec<Leg>) {
    let plan = trace.records.iter().find_map(|it| match it {
        Record::Plan(it) => Some(it),
        _ => None,
    });
    let rows = plan.map_or(&[][..], |it| &it.plan);
    let activities = &mission.scenario().activities;
    let of = |id: &str| rows.iter().find(|it| it.activity == id);
    let objectives = mission.objectives.iter().enumerate().map(|(at, it)| {
        let own = activities.iter().filter(|it| it.objective == at);
        let stands = own.filter_map(|it| of(&it.id)).map(|it| it.duration_ms).sum();
        Objective { travels: it.travels(), end_mm: it.x_end.0, stands: Millis(stands) }
    });
    let legs = activities
        .iter()
        .filter(|it| it.x_start < it.x_end)
        .filter_map(|it| Some(Leg { end_mm: it.x_end.0, speed: of(&it.id)?.speed_mm_s }));
    (objectives.collect(), legs.collect())
}

/// The parts of a plan that can be moved; and what the planner told in the run, which cannot.
fn items(mission: &Mission, trace: &Trace, faults: &Faults) -> Vec<Item> {
    let mut items: Vec<Item> = Vec::new();
    for it in &faults.of_robot {
        let kind = match &it.kind {
            IncidentKind::Failure { failure, until } => Kind::Failure(*failure, *until),
            IncidentKind::Repair(failure) => Kind::Repair(*failure),
            IncidentKind::Operator { answers, delay } => Kind::Operator(answers.clone(), delay.0),
            IncidentKind::Door { .. } => continue,
        };
        items.push(Item { kind, when: it.when, text: lines(it, mission), is_fixed: false });
    }
    // A unit of hardware that is lost is the failure of the robot's file that takes it.
    let all = Script::of(faults, mission).injections;
    let own = Script::from(&faults.of_robot[..]).injections.len();
    for it in all.get(own..).unwrap_or_default() {
        items.push(failure(it.failure, it.when, mission, false));
    }
    let robot = mission.robot().map(cotama_models::robots::RobotFile::robot);
    for it in &trace.records {
        let Record::Failure(it) = it else { continue };
        let row = robot.and_then(|robot| robot.failures.iter().position(|row| row.id == it.mode));
        // One that the plan holds is told by nobody.
        let is_own = all.iter().any(|it| Some(it.failure) == row);
        let is_plan = row.and_then(|row| Some(robot?.failures.get(row)?.no_plan && !is_own));
        if let (Some(row), Some(true)) = (row, is_plan) {
            items.push(failure(row, Moment::At(Millis(it.t_us / 1_000)), mission, true));
        }
    }
    items
}

fn failure(row: usize, when: Moment, mission: &Definition, is_fixed: bool) -> Item {
    let incident = Incident { when, kind: IncidentKind::Failure { failure: row, until: None } };
    let text = lines(&incident, mission);
    Item { kind: Kind::Failure(row, None), when, text, is_fixed }
}

/// The lines of an event without those of its moment.
fn lines(it: &Incident, mission: &Definition) -> String {
    let one = Faults { of_robot: vec![it.clone()], ..Faults::default() };
    let text = faults_text(&one, mission);
    let lines = text.split("[[event]]\n").nth(1).unwrap_or_default().lines();
    let is_moment = |it: &&str| {
        ["x_mm =", "t_ms =", "during =", "after_ms ="].iter().any(|key| it.starts_with(key))
    };
    lines.filter(|it| !is_moment(it)).collect::<Vec<_>>().join("\n")
}

/// All that no flag shows, in words.
fn unshown(rest: &Faults, mission: &Mission) -> Vec<String> {
    let metres = |mm: u64| format!("{}.{} m", mm / 1_000, mm / 100 % 10);
    let mut all = Vec::new();
    for it in &rest.events {
        let what = match it.kind {
            EventKind::Obstacle { delay } => format!("an obstacle for {} s", delay.0 / 1_000),
            EventKind::Odometry { extra } => {
                format!("a wrong position, {} more of path", metres(extra.0))
            }
            EventKind::Fault { .. } | EventKind::Repair { .. } => "repaired hardware".to_owned(),
        };
        all.push(format!("{what}, at {}", metres(it.x.0)));
    }
    for it in &rest.power_errors {
        let zone = mission.zones.get(it.zone).map_or("a zone", |it| it.id.as_str());
        all.push(format!("{} ‰ of power in {zone}", it.permille));
    }
    all.extend(rest.random.iter().map(|it| format!("{}, at random places", it.name)));
    all.extend(rest.of_robot.iter().map(|_| "a door that opens or closes".to_owned()));
    all
}

#[cfg(test)]
mod tests;
