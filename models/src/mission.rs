//! A mission: what a `panorama-mission/1` file says, with units, checked as a whole.
//!
//! # Supervised missions
//!
//! A plain mission is planned, and planned again when a margin or a piece of hardware is lost. In a
//! *supervised* mission the supervisors of COTAMA (Durand et al., TAROS 2010) decide as well. It is
//! a mission like any other, and says more:
//!
//! | key | what it says |
//! | --- | --- |
//! | `[supervision]` `decides = "cotama"` | that it is supervised |
//! | `recovery = true` there | that modules which were lost and [are sound for long enough](crate::cotama::recovery) are used again; without it nothing returns |
//! | `does` in each `[[objective]]` | [what it is](Does) to its supervisor: `drive`, `receive`, `deliver` or `wait` |
//! | `configuration` in each `[[tio]]` of the task `MOV` | the [set of modules](crate::cotama::Configuration) that runs: `PF.OPT`, `PF.OPTR`, `PF.ODO`, `PF.DEG` |
//! | `[[run.event]]` with `kind = "failure"`, `mode` | a [failure mode](crate::cotama::FailureMode) that observers have to find |
//! | `[[run.event]]` with `kind = "repair"`, `mode` | that such a failure, if it is under way, ends there |
//! | `[[run.event]]` with `kind = "operator"`, `answers`, `delay_ms` | what the operator [answers](crate::faults::Answer) to the next request, with the time before each answer |
//!
//! A drive has the task `MOV`, the others stand and have `RCV`, `DLV` or `WAI`, whose options say
//! their `duration_ms` and `power_mw` themselves; plain missions may use these three tasks, too.
//! Modules are `[hardware]` of their names, so that a lost module removes the options that need it,
//! by the rule of all hardware.
//!
//! On load, before the robot moves, its global supervisor is
//! [made](crate::cotama::mission_net::global_supervisor) from the objectives and [every marking of
//! it looked at](crate::cotama::mission_net::check); and the mission must make sense: drives lead
//! on, an object is received before it is delivered, one at a time, and delivered in the end; the
//! mission does not end with waiting; no objective passes a limit alone; the robot has the modules
//! of its configurations and of its operator's answers; and no objective *could block*, that is:
//! lose with a single module all its options, and teleoperation too. Modules without which nothing
//! drives are not counted there: without them the robot stops, as it should.

use crate::cotama::Configuration;
use crate::diagnostic::{Diagnostic, MissionErrors, Spanned};
use crate::faults::Run;
use crate::reader::{self, Sink};
use crate::scenario::{Constraint, Scenario};
use cotama_core::hardware::Equipment;
use cotama_core::net::owned::OwnedNet;
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use std::ops::{Deref, Range};

mod path;
mod read;
mod supervised;
mod supervision;

pub use supervised::MAX_SUPERVISED_OBJECTIVES;
pub use supervision::{Does, Supervision};

/// The format that a mission file must name.
pub const FORMAT: &str = "panorama-mission/1";
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

    /// Its name in mission files.
    pub const fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|task| task.name() == name)
    }

    /// Whether it decides how long an objective takes. Every objective has exactly one such task.
    pub const fn leads(self) -> bool {
        !matches!(self, Self::Localise)
    }
}

/// The robot's body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Robot {
    /// Its mass, in grams.
    pub mass_g: u64,
    /// The fastest it can go.
    pub speed_max: MillimetresPerSecond,
    /// An impact must stay strictly below this energy.
    pub impact_energy_max: Millijoules,
    /// The fastest it may go so that it does: see [`harmless_speed`].
    pub speed_harmless: MillimetresPerSecond,
}

/// The largest whole speed at which the kinetic energy m v² / 2 is strictly below `energy`; zero if
/// there is none.
///
/// ```
/// use cotama_core::units::{Millijoules, MillimetresPerSecond};
/// # use cotama_models::mission::harmless_speed;
/// assert_eq!(harmless_speed(25_000, Millijoules(4_000)), MillimetresPerSecond(565)); // 25 kg, 4 J: below 565.7
/// ```
pub const fn harmless_speed(mass_g: u64, energy: Millijoules) -> MillimetresPerSecond {
    // In these units, m v² / 2 < E is m_g * v² < 2,000,000 * E_mJ.
    let bound = energy.0.saturating_mul(2_000_000);
    match bound.saturating_sub(1).checked_div(mass_g) {
        Some(square) => MillimetresPerSecond(square.isqrt()),
        None => MillimetresPerSecond::ZERO,
    }
}

/// A kind of hardware, switched on and off in units.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hardware {
    /// Its name.
    pub name: String,
    /// How many units the robot has.
    pub units: u8,
    /// The power of one unit.
    pub power: Milliwatts,
}

/// The power of motion at speed v (mm/s): c0 + c1 v / 1000 + c2 v² / 1,000,000 mW, rounded half up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotionPower {
    /// The constant coefficient, in mW.
    pub c0: u64,
    /// The linear coefficient, in mW for each m/s.
    pub c1: u64,
    /// The square coefficient, in mW for each (m/s)².
    pub c2: u64,
}

impl MotionPower {
    /// The power at a speed; the largest power when it does not fit.
    pub const fn at(&self, speed: MillimetresPerSecond) -> Milliwatts {
        let v = speed.0 as u128;
        let linear = (self.c1 as u128 * v).saturating_mul(1000);
        let square = (self.c2 as u128).saturating_mul(v * v);
        let micro = (self.c0 as u128 * 1_000_000).saturating_add(linear).saturating_add(square);
        let power = micro.saturating_add(500_000) / 1_000_000;
        if power > u64::MAX as u128 { Milliwatts(u64::MAX) } else { Milliwatts(power as u64) }
    }
}

/// What a task takes that does not travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Standing {
    /// Its duration.
    pub duration: Millis,
    /// Its power, without that of the hardware it needs.
    pub power: Milliwatts,
}

/// A task implementation option (TIO).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tio {
    /// Its id.
    pub id: String,
    /// Where the id stands in the file.
    pub span: Range<usize>,
    /// The task that it implements.
    pub task: Task,
    /// The hardware it needs.
    pub needs: Equipment,
    /// The fastest it allows.
    pub speed_max: Option<MillimetresPerSecond>,
    /// Its quality for each 100 mm of travel.
    pub quality_per_dm: u32,
    /// Its quality in an activity that does not travel.
    pub quality: u32,
    /// What it takes standing; none for tasks that travel or run along.
    pub standing: Option<Standing>,
    /// The modules that it runs: one for each moving option of a supervised mission, none for other
    /// options.
    pub configuration: Option<Configuration>,
}

/// An objective: tasks that run at the same time on a part of the path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objective {
    /// Its id.
    pub id: String,
    /// Where the id stands in the file.
    pub span: Range<usize>,
    /// Where it starts.
    pub x_start: Millimetres,
    /// Where it ends; the same place when it does not travel.
    pub x_end: Millimetres,
    /// Its tasks: exactly one that leads, [`Task::Move`] if and only if it travels.
    pub tasks: Vec<Task>,
    /// What its supervisor takes it for; there in a supervised mission only.
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
    /// Its id.
    pub id: String,
    /// Where the id stands in the file.
    pub span: Range<usize>,
    /// Where it starts.
    pub x_start: Millimetres,
    /// Where it ends, behind its start.
    pub x_end: Millimetres,
    /// The fastest it allows.
    pub speed_max: Option<MillimetresPerSecond>,
    /// The hardware that the moving option must use.
    pub require_hardware: Option<Spanned<HardwareRequirement>>,
    /// The index of the TIO that must be used.
    pub require_tio: Option<Spanned<usize>>,
}

/// Everything a mission file says.
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
    /// Who decides while it runs; none for a plain mission, which only plans again.
    pub supervision: Option<Supervision>,
    /// Whether its supervisors use again what [returns](crate::cotama::recovering).
    pub recovery: bool,
    /// How the mission is run by a simulator.
    pub run: Run,
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

    /// The power of these units.
    pub fn power_of(&self, units: Equipment) -> Milliwatts {
        let power =
            |(kind, hardware): (usize, &Hardware)| u64::from(units.of(kind)) * hardware.power.0;
        Milliwatts(self.hardware.iter().enumerate().map(power).sum())
    }
}

/// A mission: a [`Definition`] that was checked, and the [`Scenario`] it unfolds to.
///
/// *Invariant:* the scenario is that of the definition, and none of its activities is without
/// alternatives; the supervisor of a supervised mission is made from its objectives, and checked.
/// The definition is therefore read only; its fields are those of the mission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mission {
    definition: Definition,
    scenario: Scenario,
    supervisor: Option<OwnedNet>,
}

impl Deref for Mission {
    type Target = Definition;

    fn deref(&self) -> &Definition {
        &self.definition
    }
}

impl Mission {
    /// Reads a mission file. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let definition =
            reader::document(text, &sink, FORMAT, read::definition).filter(|_| sink.is_empty());
        let mut errors = sink.into_diagnostics();
        if let Some(definition) = definition {
            match Self::checked(definition) {
                Ok(mission) => return Ok(mission),
                Err(found) => errors.extend(found),
            }
        }
        Err(MissionErrors::new(source_name, text, errors))
    }

    /// The whole of a definition, or what is wrong with it as a whole.
    fn checked(definition: Definition) -> Result<Self, Vec<Diagnostic>> {
        let scenario = Scenario::generate(&definition)?;
        let supervisor = supervised::supervisor(&definition, &scenario)?;
        Ok(Self { definition, scenario, supervisor })
    }

    /// The global supervisor made from the objectives of a supervised mission.
    ///
    /// ```
    /// use cotama_models::{embedded, mission::Mission};
    /// let delivery = embedded::mission("delivery").unwrap();
    /// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    /// let places = &mission.supervisor().unwrap().places;
    /// let names: Vec<_> = places.iter().map(|place| place.name.as_str()).collect();
    /// assert_eq!(names, ["Wait", "DriveA", "Receive", "DriveB", "Deliver", "Done", "Security", "Safe"]);
    /// ```
    pub fn supervisor(&self) -> Option<&OwnedNet> {
        self.supervisor.as_ref()
    }

    /// The activities and their alternatives.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The mission with one constraint of a zone lifted; `None` when the zone has no such
    /// constraint.
    ///
    /// Speed limits cannot be lifted: they decide what every alternative costs.
    pub fn without_zone_constraint(&self, zone: usize, constraint: Constraint) -> Option<Self> {
        let mut definition = self.definition.clone();
        let zone = definition.zones.get_mut(zone)?;
        match constraint {
            Constraint::Hardware => zone.require_hardware.take().map(|_| ())?,
            Constraint::Tio => zone.require_tio.take().map(|_| ())?,
        }
        Self::again(definition)
    }

    /// The mission without an objective; `None` when there is no such objective, or nothing would
    /// be left, or what is left breaks a rule of supervised missions (an object delivered that was
    /// not received).
    ///
    /// An objective that does not travel is left out. One that travels cannot be left out alone,
    /// since the robot would not get to the next: the mission then ends where the objective starts,
    /// without all that follows.
    pub fn without_objective(&self, objective: usize) -> Option<Self> {
        let mut definition = self.definition.clone();
        let dropped = definition.objectives.get(objective)?;
        if dropped.travels() {
            definition.path_length = dropped.x_start;
            definition.objectives.truncate(objective);
            definition.run.faults.events.retain(|event| event.x <= definition.path_length);
            definition.run.faults.incidents.retain(|incident| incident.x <= definition.path_length);
        } else {
            definition.objectives.remove(objective);
        }
        if definition.objectives.is_empty() { None } else { Self::again(definition) }
    }

    fn again(definition: Definition) -> Option<Self> {
        Self::checked(definition).ok()
    }
}
