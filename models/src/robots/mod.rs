//! A robot as data: what it is made of, what can fail, and how it goes on.
//!
//! A `cotama-robot/1` file names hardware, modules, configurations, observers with their flags, and
//! failures ([`Robot::parse`]). Of it the supervisors of COTAMA are made ([`supervisors::system`],
//! Durand et al., TAROS 2010, Sections III to V), and the requirements that a checker is asked
//! ([`requirements::of`]). What a failure leads to is one function, [`decide`]: the contextual
//! supervisor is made from it.
//!
//! ```
//! use cotama_models::robots::{Decision, Robot, Situation, Where, decide};
//! let text = r#"
//! format = "cotama-robot/1"
//! name = "scout"
//! [hardware.lidar]
//! [hardware.base]
//! [module.drive]
//! hardware = ["base"]
//! [module.scan]
//! hardware = ["lidar"]
//! [observer.watch]
//! flags = ["scan_late", "base_silent"]
//! [[configuration]]
//! name = "Avoiding"
//! sub_objective = "Follow"
//! mode = "autonomous"
//! required = ["drive", "scan"]
//! speed_mm_s = 600
//! [[configuration]]
//! name = "Blind"
//! sub_objective = "Follow"
//! mode = "autonomous"
//! required = ["drive"]
//! speed_mm_s = 100
//! [[failure]]
//! id = "LID1"
//! mode = "no scan"
//! severity = { autonomous = "medium" }
//! flags = ["scan_late"]
//! loses = ["lidar"]
//! [[failure]]
//! id = "BAS1"
//! mode = "no answer of the base"
//! severity = { autonomous = "fatal" }
//! flags = ["base_silent"]
//! loses = ["base"]
//! "#;
//! let robot = Robot::parse("scout.toml", text).unwrap();
//! let running = |configuration| Situation {
//!     at: Where::Runs { sub_objective: 0, configuration },
//!     lost: 0b01, // the lidar, which the first report says
//! };
//! assert_eq!(robot.best(0, 0b01), Some(1)); // `Blind` is what is left
//! assert_eq!(decide(&robot, 0, running(0)), Decision::Adapt);
//! assert_eq!(decide(&robot, 0, running(1)), Decision::Record);
//! assert_eq!(decide(&robot, 1, running(1)), Decision::Stop);
//! ```

mod available;
mod decision;
mod embedded;
mod file;
mod fired;
mod in_time;
pub mod known;
mod losses;
mod masking;
mod measured;
mod powered;
mod printed;
mod reached;
mod reaction;
mod reader;
pub mod requirements;
mod response;
mod script;
pub mod sensing;
mod settings;
pub mod signals;
mod sound;
pub mod supervisors;
mod tables;
#[cfg(test)]
mod tests;

pub use crate::level::{
    Global, MAX_CONFIGURATIONS, MAX_FAILURES, MAX_FLAGS, MAX_LOSSES, MAX_MASKS, MAX_REPORTS, Mode,
    Told, Where,
};
pub use decision::{Decision, Situation, ask_first, decide};
pub use embedded::{EMBEDDED, EmbeddedRobot, embedded, embedded_measurement};
pub use file::RobotFile;
pub use fired::{Fired, fired, name_of};
pub use known::FORMAT;
pub use losses::{Loss, Losses, Report};
pub use measured::{Detection, MAX_MEASURED_RUNS, MEASURED_FORMAT, Measurement};
pub use powered::{Battery, Motors};
pub use printed::to_rust;
pub use reaction::{Mask, Try};
pub use response::{ADAPTS_IN, ASKS_IN, ENDS_IN, KNOWN_IN};
pub use script::{Answer, Incident, IncidentKind, Moment};
pub use sensing::Sensing;
pub use settings::{Parameter, Setting, Value};
pub use signals::{Harm, Harmed, Role, Watch};
pub use tables::OwnedTables;

use crate::missions::MotionPower;
use crate::severity::{Persistence, Severity};
use cotama_core::net::owned::OwnedNet;
use cotama_core::units::{Micros, Millimetres, MillimetresPerSecond, Millis, Milliwatts};

/// The most kinds of hardware, and the most modules.
pub const MAX_PARTS: usize = 64;
/// A robot. Modules, hardware and the other parts are numbered in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Robot {
    /// Name of the robot.
    pub name: String,
    /// The robot in a few words; may be empty.
    pub title: String,
    /// The body, without which no mission runs.
    pub body: Option<Body>,
    /// Hardware on which modules stand.
    pub hardware: Vec<Hardware>,
    /// Programs that sense, compute and act.
    pub modules: Vec<Module>,
    /// Sub-objectives of a drive. The autonomous ones follow one another in this order.
    pub sub_objectives: Vec<SubObjective>,
    /// Sets of modules that serve a sub-objective.
    pub configurations: Vec<Configuration>,
    /// The modules by which an operator is reached; `None` without an operator.
    pub operator: Option<u64>,
    /// Observers, with the flags that they raise.
    pub observers: Vec<Observer>,
    /// Failures: the rows of the FMECA.
    pub failures: Vec<Failure>,
    /// Names under which rows count together how often a module is started anew.
    pub shared: Vec<String>,
    /// Reports of failures, and the losses that differ.
    pub losses: Losses,
    /// The local supervisor, where the file names a net of its own; else it is made.
    pub local: Option<OwnedNet>,
}

/// The body of a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Body {
    /// The fastest that it can go.
    pub speed_max: MillimetresPerSecond,
    /// How fast it speeds up and slows down, in mm/s².
    pub acceleration: u64,
    /// The radius of the disc in which it turns on the spot.
    pub radius: Millimetres,
    /// The period of its control loop, and of the rounds of its supervisors.
    pub period: Millis,
    /// The power of motion.
    pub motion_power: MotionPower,
    /// Mass, in grams, and the energy in mJ below which an impact must stay; `None` where no impact
    /// is limited.
    pub impact: Option<(u64, u64)>,
    /// Its wheels.
    pub wheels: Wheels,
    /// Their motors; `None` where nothing is known of them.
    pub motors: Option<Motors>,
    /// Battery; `None` where nothing is known of it.
    pub battery: Option<Battery>,
    /// Devices by which it senses in the plane.
    pub sensing: Sensing,
    /// Source of what is said of it; may be empty.
    pub source: String,
}

/// Two driven wheels on one axle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wheels {
    /// Radius, in µm.
    pub radius_um: u64,
    /// Distance between them.
    pub axle: Millimetres,
    /// How fast the robot turns, in thousandths of rad/s.
    pub turn_mrad_s: u64,
    /// How fast it begins and ends to turn, in thousandths of rad/s².
    pub turn_acceleration: u64,
    /// Counts of an encoder in a turn of its wheel.
    pub counts: u64,
    /// Errors of the left radius, of the right one and of the distance, in millionths: the robot
    /// does not know them.
    pub errors_ppm: [i32; 3],
}

impl Default for Wheels {
    /// The wheels of a Pioneer 3-DX, without errors: Webots, `Pioneer3dx.proto`; its counts by its
    /// operations manual; turning as the emulated firmware of `AMRISim` does.
    fn default() -> Self {
        Self {
            radius_um: 97_500,
            axle: Millimetres(330),
            turn_mrad_s: 1_745,
            turn_acceleration: 1_745,
            counts: 76_600,
            errors_ppm: [0; 3],
        }
    }
}

/// The effect of a failure on motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Motion {
    /// No effect.
    #[default]
    Free,
    /// The robot gets no further along its path, though it moves.
    Blocked,
    /// The robot goes at this speed, in thousandths of the commanded one.
    Slowed(u16),
    /// The robot goes at full speed, whatever it is told, until motor power is cut.
    Runaway,
    /// Motors are without power: it stands.
    Dead,
    /// No command arrives: the micro-controller stops the motors by itself after two seconds.
    Silent,
    /// The same, since the laptop is down: nothing is observed or decided any more.
    Mindless,
}

/// A set of hardware and modules, a bit each by number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Parts {
    /// Hardware.
    pub hardware: u64,
    /// Modules.
    pub modules: u64,
}

/// A kind of hardware.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hardware {
    /// Name of the hardware.
    pub name: String,
    /// The hardware in a few words; may be empty.
    pub title: String,
    /// How many of it there are.
    pub units: u8,
    /// The power of all units together.
    pub power: Milliwatts,
    /// The hardware of missions that it is a unit of; its own name where nothing else is said.
    pub kind: String,
    /// Source of what is said of it; may be empty.
    pub source: String,
}

/// A module of the executive level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Module {
    /// Name of the module.
    pub name: String,
    /// The module in a few words; may be empty.
    pub title: String,
    /// The parts that it needs, all of them.
    pub needs: Parts,
    /// The modules of which it needs one; none when empty.
    pub one_of: u64,
    /// How often it runs; `None` where it is not scheduled.
    pub period: Option<Millis>,
    /// When it must be done after its release; the period where nothing else is said.
    pub deadline: Option<Millis>,
    /// Worst-case execution time, without the costs of its parameters.
    pub cost: Option<Micros>,
    /// Urgency, 0 before all; among equals the shorter deadline goes first.
    pub priority: u8,
    /// Numbers that can be set while it runs.
    pub parameters: Vec<Parameter>,
    /// The option of missions that it serves, by its id; may be empty.
    pub serves: String,
    /// The algorithms that it runs in the plane.
    pub roles: Vec<Role>,
    /// Source of what is said of it; may be empty.
    pub source: String,
}

/// A sub-objective of a drive: a part of it that one set of modules serves at a time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubObjective {
    /// Name of the sub-objective.
    pub name: String,
    /// Decider of motion in it.
    pub mode: Mode,
    /// Whether the robot may move in it: some configuration has a speed.
    pub moves: bool,
    /// Its configurations, the best one first.
    pub configurations: Vec<usize>,
}

/// A set of modules that serves a sub-objective.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Configuration {
    /// Name of the configuration.
    pub name: String,
    /// The sub-objective that it serves.
    pub sub_objective: usize,
    /// The modules without which it cannot run, and all that they need.
    pub required: u64,
    /// The modules that it uses when they are there.
    pub optional: u64,
    /// The fastest that the robot may go with it.
    pub speed: MillimetresPerSecond,
    /// How long it takes where the robot stands in it.
    pub takes: Millis,
    /// Source of what is said of it; may be empty.
    pub source: String,
}

/// An observer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observer {
    /// Name of the observer.
    pub name: String,
    /// The observer in a few words; may be empty.
    pub title: String,
    /// The parts that it needs to see anything.
    pub needs: Parts,
    /// The flags that it raises.
    pub flags: Vec<String>,
    /// The signal of each flag, where it has one in the plane; of no flag, or of all.
    pub watches: Vec<Option<Watch>>,
    /// Whether what it alone watches counts as lost while it sees nothing.
    pub closes: bool,
}

/// A failure: a row of the FMECA.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Short name, for example `LID1`.
    pub id: String,
    /// The function that suffers; may be empty.
    pub function: String,
    /// The part that fails, in words; may be empty.
    pub item: String,
    /// How it fails.
    pub mode: String,
    /// Why; may be empty.
    pub cause: String,
    /// The effect; may be empty.
    pub effect: String,
    /// How severe it is where the robot drives itself.
    pub autonomous: Severity,
    /// How severe it is where the operator does.
    pub operator: Severity,
    /// How long it lasts.
    pub persistence: Persistence,
    /// The flags that always show it, by their position in the flags of all observers in order.
    pub flags: Vec<usize>,
    /// The flags that show it at times.
    pub sometimes: Vec<usize>,
    /// Why nothing shows it; `None` where flags do.
    pub unseen: Option<String>,
    /// How long after it the flags are up.
    pub latency: Millis,
    /// The parts lost with it.
    pub loses: Parts,
    /// The effect on motion.
    pub motion: Motion,
    /// The harm that it does in the plane; `None` where only its flags can be told.
    pub harm: Option<Harmed>,
    /// When it is over by itself; `None` where it is not.
    pub ends: Option<Millis>,
    /// Whether it is over when the operator has helped.
    pub helped: bool,
    /// Whether it is that no plan keeps the limits of the mission: the planner tells it.
    pub no_plan: bool,
    /// Whether the operator answers nothing while it lasts.
    pub unanswered: bool,
    /// How often a module is started anew before anything counts as lost.
    pub restarts: Option<Restarts>,
    /// The setting that answers it.
    pub sets: Option<Setting>,
    /// How often the operator is asked before severity and availability decide.
    pub asks: Option<u8>,
    /// The flags that are masked once it is told.
    pub masks: Option<Mask>,
    /// The reactions that are tried before it is decided, in their order.
    pub tries: Vec<Try>,
    /// The mean time between two failures, in thousandths of an hour; `None` where nobody knows.
    pub mean_mh: Option<u64>,
    /// Source of what is said of it; may be empty.
    pub source: String,
}

/// A reaction before any other: a module is started anew, so many times in a mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Restarts {
    /// The module.
    pub module: usize,
    /// How often.
    pub times: u8,
    /// The name of [`Robot::shared`] under which rows count together; `None` where it counts alone.
    pub shared: Option<usize>,
    /// Whether the failure is over by it, also one that does not pass by itself.
    pub mends: bool,
}

impl Failure {
    /// Whether it can end without a repair after the mission.
    pub fn can_be_over(&self) -> bool {
        self.helped || self.ends.is_some() || self.persistence != Persistence::Permanent
    }

    /// How severe it is in a mode.
    pub const fn severity(&self, mode: Mode) -> Severity {
        match mode {
            Mode::Autonomous => self.autonomous,
            Mode::Operator => self.operator,
        }
    }
}

impl Parts {
    /// No part.
    pub const NONE: Self = Self { hardware: 0, modules: 0 };

    /// Returns the union of both.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self { hardware: self.hardware | other.hardware, modules: self.modules | other.modules }
    }
}

/// The positions of the bits of a set.
pub fn members(set: u64) -> impl Iterator<Item = usize> {
    (0..64).filter(move |it| set >> it & 1 == 1)
}
