//! Missions from the command line: by name or from a file, with limits and hardware changed.

use crate::args::{AllocatorName, Lost, Objective, Planning, STEPS};
use crate::exit::Failure;
use crate::floor;
use crate::input;
use crate::kind::{self, Kind};
use crate::names::{is_name, near};
use crate::output::Screen;
use crate::robot;
use cotama_campaign::subject::Subject;
use cotama_core::hardware::Equipment;
use cotama_models::missions::{Asked, Definition, Mission, PlannedFor, embedded};
use cotama_models::robots::{self, RobotFile};
use cotama_sim::options::{By, Planner};
use std::path::Path;

/// The source of a mission that came from there.
const STANDARD_INPUT: &str = "standard input";

/// The mission of this name, or of the file at this path; warnings of its floor go to the screen.
pub(crate) fn load(name: &str, screen: Option<&Screen>) -> Result<Mission, Failure> {
    loaded(name, None, screen)
}

/// The mission of this name under the supervisors of a robot: its own, or the given one of a plain
/// mission.
pub(crate) fn under(name: &str, robot: &str) -> Result<Mission, Failure> {
    let mission = loaded(name, None, None)?;
    if mission.is_supervised() { Ok(mission) } else { loaded(name, Some(robot), None) }
}

/// The mission of this name; `supervised` is the robot whose supervisors are to decide.
pub(crate) fn loaded(
    name: &str,
    supervised: Option<&str>,
    screen: Option<&Screen>,
) -> Result<Mission, Failure> {
    let text = match embedded::mission(name) {
        Some(known) => known.text.to_owned(),
        None if is_name(name) && !Path::new(name).exists() => {
            return Err(kind::model_for_mission(name).unwrap_or_else(|| unknown(name)));
        }
        None => kind::text(name, "a mission file", input::MISSION_BYTES, &[Kind::Mission])?,
    };
    let source = if name == "-" { STANDARD_INPUT } else { name };
    let robot = match (supervised, Mission::robot_of(&text)) {
        (Some(_), Some(_)) => {
            let message = format!("--supervised: `{name}` names its robot itself");
            return Err(Failure::new(message).help("leave --supervised out"));
        }
        (Some(""), None) => Some(robot(robot_for(name)?, None)?),
        (Some(other), None) => Some(robot(other, None)?),
        (None, Some(of)) if !is_missing(&of, source) => {
            Some(robot(&of, Path::new(source).parent())?)
        }
        (None, _) => None,
    };
    let way = match Asked::of(&text) {
        Some(asked) => floor::way(asked, Path::new(source).parent(), robot.as_ref(), screen)?,
        None => None,
    };
    Ok(Mission::parse_on(source, &text, robot, way.as_ref())?)
}

/// Whether a mission names a robot that is neither shipped nor a file beside it: the reader says
/// where.
pub(crate) fn is_missing(of: &str, mission: &str) -> bool {
    let folder = Path::new(mission).parent();
    robots::embedded(of).is_none() && !folder.is_some_and(|it| it.join(of).exists())
}

/// The robot that is meant where a mission is to be supervised, and none is named.
fn robot_for(mission: &str) -> Result<&'static str, Failure> {
    match mission {
        "patrol" => Ok("p3dx-patrol"),
        _ => Err(Failure::new("--supervised: which robot?")
            .help("name one: `--supervised transport`, or the path of a file")),
    }
}

/// The robot of this name, or of the file at this path, which may be relative to a folder.
pub(crate) fn robot(name: &str, folder: Option<&Path>) -> Result<RobotFile, Failure> {
    if let Some(it) = RobotFile::shipped(name) {
        return Ok(it);
    }
    let path = folder.map_or_else(|| name.to_owned(), |it| it.join(name).display().to_string());
    if !Path::new(&path).exists() {
        let names: Vec<_> = robots::EMBEDDED.iter().map(|it| it.name).collect();
        let guess = near(name, names.iter().copied())
            .map_or_else(String::new, |known| format!("; did you mean `{known}`?"));
        let message = format!("there is no robot `{name}`, and no file of this name{guess}");
        let help = format!("robots that come with the program: {}", names.join(", "));
        return Err(Failure::new(message).help(help));
    }
    let text = kind::text(&path, "a robot's file", input::MISSION_BYTES, &[Kind::Robot])?;
    robot::robot_file(&path, &text)
}

/// A subject of a campaign whose failures name this source, if it can be read again.
pub(crate) fn named<'m>(subject: Subject<'m>, source: &str) -> Subject<'m> {
    if source == STANDARD_INPUT { subject } else { subject.named(source) }
}

/// The mission for a plan or a run, with the limits of the command line.
pub(crate) fn load_for(
    name: &str,
    planning: &Planning,
    screen: Option<&Screen>,
) -> Result<Mission, Failure> {
    let mission = loaded(name, planning.supervised.as_deref(), screen)?;
    let limits = [planning.duration_limit, planning.energy_limit];
    if limits == [None, None] { Ok(mission) } else { Ok(mission.with_limits(limits)?) }
}

/// Refuses options that say what plans are for, of a mission whose wishes say it.
pub(crate) fn beside_wishes(mission: &Mission, given: &[(&str, bool)]) -> Result<(), Failure> {
    let found = given.iter().find(|it| it.1).filter(|_| mission.plans_by_wishes());
    let Some((option, _)) = found else { return Ok(()) };
    let message = format!("{option}: `ask` of `{}` says what its plans are for", mission.name);
    Err(Failure::new(message).help(format!("leave {option} out, or `ask`")))
}

/// Returns the objective of a plan: the wanted one, else that of the mission file, else quality.
/// The allocator of PANORAMA has a rule and no objective, so wanting it means the paper's.
pub(crate) fn objective(
    wanted: Option<Objective>,
    allocator: Option<AllocatorName>,
    mission: &Mission,
) -> Objective {
    let rule = (allocator == Some(AllocatorName::Panorama)).then_some(Objective::Paper);
    let own = || match Planner::of(mission).parts().0 {
        PlannedFor::Paper => Objective::Paper,
        PlannedFor::Quality => Objective::Quality,
        PlannedFor::MinEnergy => Objective::MinEnergy,
    };
    wanted.or(rule).unwrap_or_else(own)
}

/// Refuses an objective that the rule of PANORAMA does not pursue.
pub(crate) fn pursued(
    wanted: Option<Objective>,
    allocator: Option<AllocatorName>,
) -> Result<(), Failure> {
    let rule = allocator == Some(AllocatorName::Panorama);
    match wanted.filter(|it| rule && *it != Objective::Paper) {
        None => Ok(()),
        Some(it) => {
            let message =
                format!("--objective {} with --allocator panorama: it pursues none", it.name());
            Err(Failure::new(message).help("--allocator exact pursues it"))
        }
    }
}

/// Refuses a number of steps where nothing is searched.
pub(crate) fn searched(is_rule: bool, steps: u64) -> Result<(), Failure> {
    if is_rule && steps != STEPS {
        let message = "--steps bounds a complete search, and this is planned by the paper’s rule";
        return Err(Failure::new(message).help("leave --steps out, or add --allocator exact"));
    }
    Ok(())
}

/// Returns the planner for this objective; a front is none of a run's.
///
/// # Errors
/// A [`Failure`] where steps are given and nothing is searched.
pub(crate) fn planner(
    objective: Objective,
    allocator: Option<AllocatorName>,
    steps: u64,
) -> Result<Planner, Failure> {
    let objective = match objective {
        Objective::Paper => PlannedFor::Paper,
        Objective::MinEnergy => PlannedFor::MinEnergy,
        Objective::Quality | Objective::Front => PlannedFor::Quality,
    };
    let by = allocator.map(|it| match it {
        AllocatorName::Exact => By::Exact,
        AllocatorName::Panorama => By::Panorama,
    });
    let planner = Planner::chosen(objective, by, steps);
    searched(matches!(planner, Planner::Panorama), steps)?;
    Ok(planner)
}

fn unknown(name: &str) -> Failure {
    let with_axes = cotama_axes::EMBEDDED.iter().map(|mission| mission.name);
    let names = embedded::embedded().iter().map(|mission| mission.name).chain(with_axes);
    let names: Vec<_> = names.collect();
    let guess = near(name, names.iter().copied())
        .map_or_else(String::new, |known| format!("; did you mean `{known}`?"));
    Failure::new(format!("there is no mission `{name}`, and no file of this name{guess}")).help(
        format!(
            "missions that come with the program: {}; or give the path of a mission file",
            names.join(", ")
        ),
    )
}

/// Hardware that was lost from the start: kinds with their units.
pub(crate) fn lost(mission: &Definition, lost: &[Lost]) -> Result<Vec<(usize, u8)>, Failure> {
    lost.iter().map(|one| find_lost(mission, one)).collect()
}

fn find_lost(mission: &Definition, lost: &Lost) -> Result<(usize, u8), Failure> {
    let names = || {
        mission
            .hardware
            .iter()
            .map(|it| format!("{} ({})", it.name, it.units))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let found = mission.hardware.iter().enumerate().find(|(_, it)| it.name == lost.kind);
    let Some((kind, hardware)) = found else {
        return Err(Failure::new(format!("--lost {}: the robot has no such hardware", lost.kind))
            .help(format!("it has: {}", names())));
    };
    let units = lost.units.unwrap_or(hardware.units);
    if units > hardware.units {
        let message =
            format!("--lost {}:{units}: the robot has only {}", lost.kind, hardware.units);
        return Err(Failure::new(message).help(format!("it has: {}", names())));
    }
    Ok((kind, units))
}

/// The hardware of a mission that is left.
pub(crate) fn available(mission: &Definition, lost: &[(usize, u8)]) -> Equipment {
    lost.iter().fold(mission.available(), |units, &(kind, count)| units.without(kind, count))
}
