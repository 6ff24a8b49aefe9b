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

mod drawn;
pub(crate) mod failing;
mod hindered;
mod measure;
mod monitor;
pub(crate) mod operator;
mod script;
mod summary;
#[cfg(test)]
mod twin;
mod undriven;
mod world;

use crate::body::Ground;
use crate::options::{Fidelity, Options, Planner};
use crate::plan::{Plannable, Planning, Progress};
use crate::record::{Recorder, Silent};
use crate::run::{NoPlan, Outcome, PlanMade};
use crate::setup::belong;
use cotama_core::player::{Packed, Program, words};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::margins::Spent;
use cotama_models::missions::Mission;
use cotama_models::robots::supervisors::{self, OwnedSystem};
use cotama_models::robots::{Decision, Measurement, OwnedTables, Told, Where};
use cotama_plane::Course;
use cotama_senses::Bench;
use drawn::Drawing;
pub use measure::WINDOW;
use monitor::Watching;
pub use monitor::{Monitor, Unmonitored, Violation};
pub use script::{Answers, DoorChange, Injection, Script};
use std::collections::BTreeSet;
use std::sync::Arc;
pub use undriven::Undriven;
use world::World;

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
    /// Amounts of each activity that it came to, in their order.
    pub spent: Vec<Spent>,
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
    /// The drive, by its number, to whose goal nothing leads any more, and the door in its way:
    /// they ended it.
    pub blocked: Option<(usize, usize)>,
    /// The end constraint of a mission with axes that does not hold, by its number among those of
    /// the scenario, and by how much.
    pub missed: Option<(usize, u64)>,
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
    /// Measured detections, in place of assumed latencies, of failures that are told.
    measured: Option<Arc<Measurement>>,
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
        belong(options, mission).map_err(Undriven::Foreign)?;
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
            measured: options.measured.clone(),
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

    /// Noise and people of its runs are drawn by this seed, and measured detections.
    #[must_use]
    pub fn seeded(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Failures that are told are found as they were measured, in place of assumed latencies: each
    /// draws one of its measured runs, by the seed and its time.
    #[must_use]
    pub fn measured(self, measurement: Arc<Measurement>) -> Self {
        Self { measured: Some(measurement), ..self }
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
        if let Some(it) = &self.measured {
            world.draw(Drawing::new(Arc::clone(it), self.seed));
        }
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
