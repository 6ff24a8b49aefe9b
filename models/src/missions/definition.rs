//! The contents of a mission file, as data with units.

use super::diagnostic::Spanned;
use super::faults::Run;
use super::numbers::Numbers;
use super::people::People;
use super::terms::{MotionPower, PlannedFor};
use super::under::Under;
use super::way::Way;
use crate::names::nearest;
use cotama_core::hardware::Equipment;
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use std::ops::Range;

/// The names of the performance axes, by index.
pub const AXES: [&str; 2] = ["duration", "energy"];

/// A task of an objective. All tasks of an objective run at the same time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Task {
    /// `MOV`: travel along the path.
    Move,
    /// `TUR`: turn on the spot.
    Turn,
    /// `DET`: detect the state of something, standing.
    Detect,
    /// `LOC`: localise, along with another task.
    Localise,
    /// `RCV`: receive an object, standing.
    Receive,
    /// `DLV`: hand an object over, standing.
    Deliver,
    /// `WAI`: wait, standing.
    Wait,
    /// One of the user's own, standing.
    Own(OwnTask),
}

/// The name of a task of the user's own, for example `GRASP`: 2 to 16 ASCII capitals, digits and
/// `_`, the first a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct OwnTask {
    bytes: [u8; 16],
    length: u8,
}

impl OwnTask {
    /// The task of this name; `None` if it is no name of a task.
    ///
    /// ```
    /// use cotama_models::missions::OwnTask;
    /// assert_eq!(OwnTask::new("GRASP").unwrap().name(), "GRASP");
    /// assert_eq!(OwnTask::new("grasp"), None);
    /// ```
    pub fn new(name: &str) -> Option<Self> {
        let is_word = |it: u8| it.is_ascii_uppercase() || it.is_ascii_digit() || it == b'_';
        let starts = name.starts_with(|it: char| it.is_ascii_uppercase());
        let mut bytes = [0; 16];
        if !starts || name.len() < 2 || !name.bytes().all(is_word) {
            return None;
        }
        bytes.get_mut(..name.len())?.copy_from_slice(name.as_bytes());
        Some(Self { bytes, length: name.len() as u8 })
    }

    /// Returns the name.
    pub fn name(&self) -> &str {
        let bytes = self.bytes.get(..usize::from(self.length)).unwrap_or_default();
        core::str::from_utf8(bytes).unwrap_or_default()
    }
}

impl Task {
    /// The names of the tasks in mission files, in the order of the enum.
    pub const NAMES: [&str; 7] = ["MOV", "TUR", "DET", "LOC", "RCV", "DLV", "WAI"];

    const ALL: [Self; 7] = [
        Self::Move,
        Self::Turn,
        Self::Detect,
        Self::Localise,
        Self::Receive,
        Self::Deliver,
        Self::Wait,
    ];

    /// Returns the name in mission files.
    pub fn name(&self) -> &str {
        match self {
            Self::Move => "MOV",
            Self::Turn => "TUR",
            Self::Detect => "DET",
            Self::Localise => "LOC",
            Self::Receive => "RCV",
            Self::Deliver => "DLV",
            Self::Wait => "WAI",
            Self::Own(it) => it.name(),
        }
    }

    /// The task of this name: a known one, or one of the user's own, which is not nearly a known
    /// one.
    pub(super) fn from_name(name: &str) -> Option<Self> {
        let known = Self::ALL.into_iter().find(|task| task.name() == name);
        let is_new = || nearest(name, Self::NAMES.into_iter()).is_none();
        known.or_else(|| OwnTask::new(name).filter(|_| is_new()).map(Self::Own))
    }

    /// Whether it decides how long an objective takes. Every objective has exactly one such task.
    pub const fn leads(self) -> bool {
        !matches!(self, Self::Localise)
    }
}

/// The kind of an objective for its supervisor (Durand et al., TAROS 2010, Sections IV.A.1 and
/// V.C.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Does {
    /// The robot drives along the path.
    Drive,
    /// The robot waits until an object is on board.
    Receive,
    /// The robot hands the object over.
    Deliver,
    /// The robot waits for a time.
    Wait,
    /// The robot stands for a task of the user's own, named in small letters: `grasp` for `GRASP`.
    Own(OwnTask),
}

impl Does {
    /// The names in mission files, in the order of the enum.
    pub const NAMES: [&str; 4] = ["drive", "receive", "deliver", "wait"];

    pub(super) const ALL: [Self; 4] = [Self::Drive, Self::Receive, Self::Deliver, Self::Wait];

    /// Returns the name in mission files.
    pub fn name(&self) -> String {
        match self {
            Self::Drive => "drive".to_owned(),
            Self::Receive => "receive".to_owned(),
            Self::Deliver => "deliver".to_owned(),
            Self::Wait => "wait".to_owned(),
            Self::Own(it) => it.name().to_ascii_lowercase(),
        }
    }

    /// The kind of this name, in a mission whose robot has a file of its own.
    pub(super) fn own(name: &str) -> Option<Self> {
        let is_new = nearest(name, Self::NAMES.into_iter()).is_none();
        match Task::from_name(&name.to_ascii_uppercase()) {
            Some(Task::Own(it)) if is_new && !name.contains(|it: char| it.is_ascii_uppercase()) => {
                Some(Self::Own(it))
            }
            _ => None,
        }
    }

    /// The task that leads such an objective.
    pub const fn task(self) -> Task {
        match self {
            Self::Drive => Task::Move,
            Self::Receive => Task::Receive,
            Self::Deliver => Task::Deliver,
            Self::Wait => Task::Wait,
            Self::Own(it) => Task::Own(it),
        }
    }
}

/// The robot's body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Robot {
    /// Mass, in grams.
    pub mass_g: u64,
    /// The fastest it can go.
    pub speed_max: MillimetresPerSecond,
    /// An impact must stay strictly below this energy.
    pub impact_energy_max: Millijoules,
    /// The fastest it may go so that it does: see [`harmless_speed`](super::harmless_speed).
    pub speed_harmless: MillimetresPerSecond,
    /// Numbers that formulas of axes read.
    pub own: Numbers,
}

/// A kind of hardware, switched on and off in units.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hardware {
    /// Name of the kind of hardware.
    pub name: String,
    /// How many units the robot has.
    pub units: u8,
    /// The power of one unit.
    pub power: Milliwatts,
    /// Numbers that formulas of axes read.
    pub own: Numbers,
}

/// Time and power of a task that does not travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Standing {
    /// Duration of the task.
    pub duration: Millis,
    /// Power of the task, without that of the hardware it needs.
    pub power: Milliwatts,
}

/// A task implementation option (TIO).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tio {
    /// Id of the task.
    pub id: String,
    /// Position of the id in the file, in bytes.
    pub span: Range<usize>,
    /// The task that it implements.
    pub task: Task,
    /// The hardware it needs.
    pub needs: Equipment,
    /// The fastest it allows.
    pub speed_max: Option<MillimetresPerSecond>,
    /// Quality for each 100 mm of travel.
    pub quality_per_dm: u32,
    /// Quality in an activity that does not travel.
    pub quality: u32,
    /// Time and power of the task standing; `None` for tasks that travel or run along.
    pub standing: Option<Standing>,
    /// Numbers that formulas of axes read.
    pub own: Numbers,
}

/// An objective: tasks that run at the same time on a part of the path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objective {
    /// Id of the objective.
    pub id: String,
    /// Position of the id in the file, in bytes.
    pub span: Range<usize>,
    /// Start on the path.
    pub x_start: Millimetres,
    /// End on the path; the same place when the objective does not travel.
    pub x_end: Millimetres,
    /// The tasks: exactly one that leads, [`Task::Move`] if and only if the objective travels.
    pub tasks: Vec<Task>,
    /// The kind of the objective for its supervisor; given in a supervised mission only.
    pub does: Option<Spanned<Does>>,
}

impl Objective {
    /// Whether it moves along the path.
    pub fn travels(&self) -> bool {
        self.x_start < self.x_end
    }
}

/// A hardware that the moving option must use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HardwareRequirement {
    /// The index of the hardware.
    pub hardware: usize,
    /// At least so many units of it.
    pub units: u8,
}

/// A part of the path with constraints on the activities that travel there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Zone {
    /// Id of the zone.
    pub id: String,
    /// Position of the id in the file, in bytes.
    pub span: Range<usize>,
    /// Start on the path.
    pub x_start: Millimetres,
    /// End on the path, behind the start.
    pub x_end: Millimetres,
    /// The fastest it allows.
    pub speed_max: Option<MillimetresPerSecond>,
    /// The hardware that the moving option must use.
    pub require_hardware: Option<Spanned<HardwareRequirement>>,
    /// The index of the TIO that must be used.
    pub require_tio: Option<Spanned<usize>>,
    /// The kinds of hardware that see no obstacles here, by index.
    pub blind: Vec<usize>,
    /// Numbers that formulas of axes read.
    pub own: Numbers,
}

/// Everything a mission file says.
///
/// ```
/// use cotama_models::missions::{Mission, PlannedFor, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// // A `Mission` is read as its definition.
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// assert_eq!((mission.name.as_str(), mission.planned_for), ("patrol", Some(PlannedFor::Paper)));
/// assert_eq!((mission.objectives.len(), mission.zones.len()), (9, 8));
/// assert_eq!(mission.hardware[1].name, "laser");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name of the mission.
    pub name: String,
    /// The length of the path.
    pub path_length: Millimetres,
    /// The inclusive limit on each axis, in ms and mJ.
    pub limits: [u64; 2],
    /// The axes in their order of treatment.
    pub order: [usize; 2],
    /// The criterion by which plans are chosen; `None` if the file leaves that to the planner.
    pub planned_for: Option<PlannedFor>,
    /// The robot's body.
    pub robot: Robot,
    /// The hardware; its index is its kind in [`Equipment`].
    pub hardware: Vec<Hardware>,
    /// The power of motion.
    pub motion_power: MotionPower,
    /// The task implementation options.
    pub tios: Vec<Tio>,
    /// The objectives, one after the other along the path.
    pub objectives: Vec<Objective>,
    /// The zones; they may overlap.
    pub zones: Vec<Zone>,
    /// The robot from a file whose supervisors decide while the mission runs; `None` for a plain
    /// mission, which only plans again.
    pub under: Option<Under>,
    /// The way over a floor that it takes, if it names one.
    pub way: Option<Way>,
    /// The people on that floor.
    pub people: People,
    /// How the mission is run by a simulator.
    pub run: Run,
    /// Axes, constraints and wishes, where speeds and limits follow from them.
    pub axes: Option<Box<cotama_axes::Case>>,
}

impl Definition {
    /// All the hardware of the robot.
    pub fn available(&self) -> Equipment {
        let with = |units: Equipment, (kind, hardware): (usize, &Hardware)| {
            units.with(kind, hardware.units)
        };
        self.hardware
            .iter()
            .enumerate()
            .fold(Equipment::NONE, |all, one| with(all, one).unwrap_or(all))
    }

    /// Whether plans are chosen by the wishes of a mission with axes, within all end constraints.
    pub fn plans_by_wishes(&self) -> bool {
        self.axes.as_ref().is_some_and(|it| !it.ask.is_empty())
    }

    /// The power of these units.
    pub fn power_of(&self, units: Equipment) -> Milliwatts {
        let power =
            |(kind, hardware): (usize, &Hardware)| u64::from(units.of(kind)) * hardware.power.0;
        Milliwatts(self.hardware.iter().enumerate().map(power).sum())
    }
}
