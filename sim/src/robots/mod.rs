//! Missions under the supervisors that a robot's file makes: travel, energy, failures, observers
//! with their latencies, an operator.
//!
//! The supervisors are the nets that the checker explores
//! ([`system`](cotama_models::robots::supervisors::system)), one round a period, told one thing a
//! round. All else is the robot's file: what a failure does to motion and to parts, which flags
//! show it and when, and what a configuration draws.
//!
//! ```
//! use cotama_models::missions::{Mission, embedded};
//! use cotama_sim::robots::{Driven, Script};
//! use cotama_sim::run::Outcome;
//! let shift = embedded::mission("shift").unwrap();
//! let mission = Mission::parse(shift.name, shift.text).unwrap();
//! let run = Driven::new(&mission).unwrap().run(&Script::default()).unwrap();
//! assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 0));
//! ```

pub(crate) mod failing;
mod hindered;
mod measure;
mod monitor;
pub(crate) mod operator;
mod summary;
#[cfg(test)]
mod twin;
mod world;

use crate::body::Ground;
use crate::options::{Fidelity, Options, Planner};
use crate::plan::{Plannable, Planning, Progress};
use crate::record::{Recorder, Silent};
use crate::run::{NoPlan, Outcome, PlanMade};
use cotama_core::monitor::MonitorError;
use cotama_core::player::{Packed, Program, words};
use cotama_core::system::SystemError;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults, PowerError};
use cotama_models::robots::supervisors::{self, OwnedSystem};
use cotama_models::robots::{
    Answer, Decision, Incident, IncidentKind, Moment, OwnedTables, RobotFile, Told, Where,
};
use cotama_plane::{Course, NoCourse};
use cotama_senses::Bench;
pub use measure::{Measured, WINDOW};
use monitor::Watching;
pub use monitor::{Monitor, Unmonitored, Violation};
use std::collections::{BTreeSet, VecDeque};
use world::World;

/// The faults of a run, and the answers of the operator.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Script {
    /// Failures, each once.
    pub injections: Vec<Injection>,
    /// The operator's answers to requests, in their order; where there is none he has his habits.
    pub answers: Vec<Answers>,
    /// Obstacles, and positions that were wrong, sorted by place.
    pub events: Vec<Event>,
    /// By how much the real power differs from the modelled one, by zone.
    pub power_errors: Vec<PowerError>,
}

/// A failure that is to happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Injection {
    /// The moment of the failure.
    pub when: Moment,
    /// Number of the failure.
    pub failure: usize,
    /// When it ends, if not by itself.
    pub until: Option<Moment>,
}

impl Injection {
    /// A failure, by its number, that ends by itself or never.
    pub const fn new(when: Moment, failure: usize) -> Self {
        Self { when, failure, until: None }
    }
}

/// The answers of the operator to a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answers {
    /// To the first request from there on.
    pub x: Millimetres,
    /// The answers, one after the other.
    pub answers: VecDeque<Answer>,
    /// After how long each.
    pub delay: Millis,
}

impl From<&[Incident]> for Script {
    /// The failures and answers of a script.
    fn from(incidents: &[Incident]) -> Self {
        let mut script = Self::default();
        for incident in incidents {
            let when = incident.when;
            match &incident.kind {
                IncidentKind::Failure { failure, until } => {
                    script.injections.push(Injection { when, failure: *failure, until: *until });
                }
                IncidentKind::Repair(failure) => {
                    let open = |it: &&mut Injection| it.failure == *failure && it.until.is_none();
                    if let Some(it) = script.injections.iter_mut().rfind(open) {
                        it.until = Some(when);
                    }
                }
                IncidentKind::Operator { answers, delay } => {
                    let Moment::Place(x) = when else { continue };
                    let answers = answers.iter().copied().collect();
                    script.answers.push(Answers { x, answers, delay: *delay });
                }
            }
        }
        script
    }
}

impl Script {
    /// The failures, events and answers of a script of a mission. A fault of hardware is the
    /// failure of the robot's file that takes a unit of it, and nothing else; one that no failure
    /// takes is [passed over](Self::passed_over). So are random events.
    pub fn of(faults: &Faults, mission: &Mission) -> Self {
        let (events, power_errors) = (faults.events.clone(), faults.power_errors.clone());
        let mut script = Self { events, power_errors, ..Self::from(&faults.of_robot[..]) };
        for it in &faults.events {
            if let EventKind::Fault { hardware, units } = it.kind {
                let taken: Vec<_> = script.injections.iter().map(|it| it.failure).collect();
                let (when, until) = (Moment::Place(it.x), None);
                let all = units_of(mission, hardware).into_iter().filter(|it| !taken.contains(it));
                let all = all.take(usize::from(units));
                let all = all.map(|failure| Injection { when, failure, until });
                script.injections.extend(all);
            }
        }
        script
    }

    /// Returns how many of the faults of a script no robot's file says.
    pub fn passed_over(faults: &Faults, mission: &Mission) -> usize {
        let lost = |it: &&Event| match it.kind {
            EventKind::Fault { hardware, .. } => units_of(mission, hardware).is_empty(),
            EventKind::Repair { .. } => true,
            EventKind::Obstacle { .. } | EventKind::Odometry { .. } => false,
        };
        faults.events.iter().filter(lost).count() + faults.random.len()
    }
}

/// The failures that take one unit of a kind of hardware of a mission, and nothing else.
fn units_of(mission: &Mission, hardware: usize) -> Vec<usize> {
    let Some(robot) = mission.robot().map(RobotFile::robot) else { return Vec::new() };
    let Some(kind) = mission.hardware.get(hardware) else { return Vec::new() };
    let is_unit = |it: &cotama_models::robots::Failure| {
        let of = it.loses.hardware.trailing_zeros() as usize;
        it.loses.hardware.is_power_of_two()
            && it.loses.modules == 0
            && robot.hardware.get(of).is_some_and(|it| it.kind == kind.name)
    };
    (0..robot.failures.len()).filter(|it| robot.failures.get(*it).is_some_and(is_unit)).collect()
}

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// How it ended: completed, safe (the global supervisor gave up and the robot stands), or
    /// failed.
    pub outcome: Outcome,
    /// Time at the end.
    pub time: Millis,
    /// Position at the end.
    pub x: Millimetres,
    /// Duration and energy used, in ms and mJ.
    pub used: [u64; 2],
    /// How often the operator was asked by the supervisors.
    pub operator_requests: u64,
    /// Flags that signals raised while no failure was under way that harms a device and was not
    /// found: when, and the rows that they were taken for.
    pub alarms: Vec<(Millis, Vec<usize>)>,
    /// Events that the supervisors accepted, each with the number of the round before it.
    pub told: Vec<(u64, Told)>,
    /// How many rounds there were.
    pub rounds: u64,
    /// The conduct on each failure, in the order of their happening.
    pub conduct: Vec<Conduct>,
    /// Which configuration ran from when on, by its number; `None` while none did.
    pub configurations: Vec<(Millis, Option<usize>)>,
    /// The plans of PANORAMA.
    pub plans: Vec<PlanMade>,
    /// The longest time that the robot moved while a module was broken that its configuration
    /// requires.
    pub exposed: Millis,
    /// The longest way that it went on after the permit to move was gone.
    pub braked: Millimetres,
    /// Whether it moved after the global supervisor had made it safe: never, or something is wrong.
    pub moved_when_safe: bool,
    /// The longest time that a failure was to be seen, beyond the latency of its row, and was not.
    pub unseen: Millis,
    /// Whether a plan was made with what was known to be lost.
    pub planned_with_lost: bool,
    /// The failure that ended the mission, by its position in the conduct.
    pub ended_by: Option<usize>,
    /// The transitions that fired, as `ls.ask_Follow`, each once.
    pub fired: BTreeSet<String>,
    /// Position at which it ran against something, in the plane, which ended it.
    pub touched: Option<Millimetres>,
    /// The property that it broke, which ended it.
    pub violated: Option<Violation>,
}

/// The conduct on a failure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conduct {
    /// Number of the failure.
    pub failure: usize,
    /// Time of the failure.
    pub injected: Millis,
    /// Position of the robot then.
    pub x: Millimetres,
    /// Place of the robot in its drive then.
    pub during: Where,
    /// When its flags were raised.
    pub detected: Option<Millis>,
    /// The failures that the flags were taken for.
    pub taken_for: Vec<usize>,
    /// When the contextual supervisor had decided, and what.
    pub decided: Option<(Millis, Decision)>,
    /// When a supervisor first acted on it.
    pub answered: Option<Millis>,
    /// For how long, in all, the robot moved while its configuration required a module that this
    /// failure breaks.
    pub exposed: Millis,
}

/// A mission under the supervisors of a robot's file, ready to be run.
#[derive(Clone, Debug)]
pub struct Driven<'m> {
    mission: &'m Mission,
    system: OwnedSystem,
    packed: Memory,
    tables: OwnedTables,
    plannable: Plannable<'m>,
    /// The floor that it goes over, for runs in the plane.
    ground: Option<Box<Ground>>,
    /// The seed of the people there.
    seed: u64,
    monitors: Vec<Monitor>,
    /// For how long the robot is watched when it is safe.
    after: Millis,
    /// The longest time of a detection, of runs that are only about that of their first failure.
    window: Option<Millis>,
}

/// The supervisors, packed into the smallest memory that holds them.
#[derive(Clone, Debug)]
enum Memory {
    Small(Box<Packed<SMALL, 0, SLOTS>>),
    Large(Box<Packed<LARGE, 0, SLOTS>>),
}

/// Words of a marking: for the robots that come with the program, and for the largest.
pub(crate) const SMALL: usize = 8;
const LARGE: usize = 64;
/// The most events that can wait in the mailboxes of the supervisors.
pub(crate) const SLOTS: usize = 256;

/// Why a mission is not driven by the supervisors of a robot's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Undriven {
    /// The mission names no robot.
    Plain,
    /// The supervisors are too large to be played.
    TooLarge(SystemError),
    /// The limits cannot be watched.
    Unwatchable(MonitorError),
    /// The robot cannot drive over the floor.
    NoCourse(NoCourse),
    /// The devices of the robot cannot be made.
    NoSenses(String),
}

impl std::fmt::Display for Undriven {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Plain => f.write_str("the mission names no robot that has a file"),
            Self::TooLarge(why) => write!(f, "the robot's supervisors cannot be played: {why}"),
            Self::NoCourse(why) => write!(f, "the robot cannot drive in the plane: {why}"),
            Self::NoSenses(why) => write!(f, "the robot cannot sense: {why}"),
            Self::Unwatchable(why) => write!(f, "the limits cannot be watched: {why}"),
        }
    }
}

impl std::error::Error for Undriven {}

impl<'m> Driven<'m> {
    /// Makes a mission ready; [the planner of the mission](Planner::of) plans.
    ///
    /// # Errors
    /// When it names no robot, or one with more supervisors than can be played.
    pub fn new(mission: &'m Mission) -> Result<Self, Undriven> {
        Self::with(mission, &Options::default())
    }

    /// Makes a mission ready, to be planned as the options say; faults are given to each run.
    ///
    /// # Errors
    /// When it names no robot, one with more supervisors than can be played, or limits that cannot
    /// be watched.
    pub fn with(mission: &'m Mission, options: &Options) -> Result<Self, Undriven> {
        let robot = mission.robot().ok_or(Undriven::Plain)?.robot();
        let system = supervisors::of_mission(robot, &mission.steps());
        let packed = system.with(|system| {
            Ok(if words(system).is_some_and(|it| it <= SMALL) {
                Memory::Small(Box::new(Packed::of(system)?))
            } else {
                Memory::Large(Box::new(Packed::of(system)?))
            })
        });
        let packed = packed.map_err(Undriven::TooLarge)?;
        let tables = OwnedTables::of(robot, &mission.steps(), &system);
        let plannable = Plannable::new(mission, options).map_err(Undriven::Unwatchable)?;
        let ground = match options.fidelity {
            Fidelity::Line => None,
            Fidelity::Plane | Fidelity::Signal => {
                let course = Course::of(mission, options.people).map_err(Undriven::NoCourse)?;
                let body = robot.body.as_ref().filter(|_| options.fidelity == Fidelity::Signal);
                let bench = body.map(|it| Bench::of(&course, robot, it)).transpose();
                let bench = bench.map_err(|it| Undriven::NoSenses(it.to_string()))?;
                Some(Box::new(Ground { course, bench }))
            }
        };
        let (monitors, after) = (Vec::new(), Millis(0));
        Ok(Self {
            mission,
            system,
            packed,
            tables,
            plannable,
            ground,
            seed: options.seed,
            monitors,
            after,
            window: None,
        })
    }

    /// A property of its supervisors, to be watched: see [`Monitor`].
    ///
    /// # Errors
    /// When the text is no property of these supervisors, or none that can be watched.
    pub fn monitor(&self, text: &str) -> Result<Monitor, Unmonitored> {
        self.system.with(|system| Monitor::new(text, system))
    }

    /// A run ends where it breaks one of these.
    #[must_use]
    pub fn with_monitors(self, monitors: Vec<Monitor>) -> Self {
        Self { monitors, ..self }
    }

    /// A robot that is safe is watched for so long: whether it moves again.
    #[must_use]
    pub fn watched_for(self, after: Millis) -> Self {
        Self { after, ..self }
    }

    /// Noise and people of its runs are drawn by this seed.
    #[must_use]
    pub fn seeded(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Returns the floor that it goes over, of runs in the plane.
    pub fn course(&self) -> Option<&Course> {
        self.ground.as_deref().map(|it| &it.course)
    }

    /// Returns the planner.
    pub const fn planner(&self) -> Planner {
        self.plannable.planner
    }

    /// Runs it.
    ///
    /// # Errors
    /// When there is no plan at the start; nothing is run then.
    pub fn run(&self, script: &Script) -> Result<Run, NoPlan> {
        self.run_recorded(script, Millis(1_000), &mut Silent)
    }

    /// Runs it and records what happens, with a sample after every `period`, rounded up to whole
    /// rounds.
    ///
    /// # Errors
    /// When there is no plan at the start; nothing is run or recorded then.
    pub fn run_recorded<R: Recorder>(
        &self,
        script: &Script,
        period: Millis,
        recorder: &mut R,
    ) -> Result<Run, NoPlan> {
        self.system.with(|system| match &self.packed {
            Memory::Small(packed) => self.played(packed.load(system), script, period, recorder),
            Memory::Large(packed) => self.played(packed.load(system), script, period, recorder),
        })
    }

    fn played<P: Program<W, 0, SLOTS>, R: Recorder, const W: usize>(
        &self,
        program: P,
        script: &Script,
        period: Millis,
        recorder: &mut R,
    ) -> Result<Run, NoPlan> {
        let (start, available) = (Progress::start(Millimetres(0)), self.mission.available());
        let planning = Planning::start(&self.plannable, &start, available)?;
        let watching = Watching::new(&self.monitors);
        let (tables, ground) =
            (self.tables.view(), self.ground.as_deref().map(|it| (it, self.seed)));
        let world = World::start(&tables, program, planning, script, ground, period, watching);
        let Some(mut world) = world else {
            return Err(NoPlan::Infeasible); // a mission that is driven has a robot with a body
        };
        match self.window {
            None => {
                world.run(recorder);
                world.stand_for(self.after);
            }
            Some(window) => world.look(window),
        }
        Ok(world.into_run())
    }
}
