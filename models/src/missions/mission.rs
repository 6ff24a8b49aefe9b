//! A mission: what a `panorama-mission/1` file says, with units, checked as a whole.
//!
//! `plan.objective` says what plans are chosen for: `"paper"`, the rule of PANORAMA; `"quality"`;
//! or `"min-energy"`. Where it is left out, who plans decides.
//!
//! # Missions under supervisors
//!
//! A plain mission is planned, and planned again when a margin or a piece of hardware is lost. A
//! mission of [`FORMAT_2`] names its robot (`robot = "transport"`, or the path of a file), whose
//! supervisors decide as well (Durand et al., TAROS 2010). Body, hardware and options of moving are
//! the robot's, and the mission says:
//!
//! - `does` in each `[[objective]]`: [what it is](crate::missions::Does) to its supervisor,
//!   `drive`, `receive`, `deliver`, `wait`, or a task of the user's own.
//! - `[[run.event]]` with `kind = "failure"` has a `mode`, a row of the robot's file that observers
//!   have to find; with `kind = "repair"` and a `mode`, such a failure ends there.
//! - `[[run.event]]` with `kind = "operator"` has `answers`, what the operator answers to the next
//!   request, and `delay_ms`, the time before each answer.
//!
//! The global supervisor is [made](crate::robots::supervisors::of_mission) from the objectives. The
//! mission must make sense: drives lead on, an object is received before it is delivered, one at a
//! time, and delivered in the end; it does not end with waiting; no objective passes a limit alone.

use super::axed;
use super::definition::{AXES, Definition};
use super::diagnostic::{Diagnostic, MissionErrors};
use super::lowering;
use super::reader::{self, Sink};
use super::scenario::{Constraint, Derived, Scenario, Slowed, ends, slowed};
use super::supervised;
use super::under::{FORMAT_2, FORMAT_3, Under, is_axed, of_robot};
use super::way::Way;
use crate::robots::{Moment, RobotFile, supervisors::Step};
use cotama_core::hardware::Equipment;
use std::ops::Deref;

/// The format that a mission file must name.
pub const FORMAT: &str = "panorama-mission/1";

/// A mission: its file, and the [`Unfolded`] definition that the file says.
///
/// *Invariant:* the definition is that of the text, so that a mission is written by its text.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// assert_eq!((mission.path_length.0, mission.limits), (187_000, [600_000, 8_640_000]));
/// assert_eq!(mission.scenario().activities.len(), 17);
///
/// let wrong = patrol.text.replace("name = \"patrol\"", "nam = \"patrol\"");
/// let errors = Mission::parse("mine.toml", &wrong).unwrap_err();
/// assert_eq!(errors.diagnostics().len(), 1);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mission {
    source: String,
    text: String,
    unfolded: Unfolded,
}

/// A [`Definition`] that was checked as a whole, and the [`Scenario`] it unfolds to.
///
/// *Invariant:* the scenario is that of the definition, and none of its activities is without
/// alternatives. The definition is therefore read only; its fields are those of the mission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unfolded {
    definition: Definition,
    scenario: Scenario,
}

impl Deref for Mission {
    type Target = Unfolded;

    fn deref(&self) -> &Unfolded {
        &self.unfolded
    }
}

impl Deref for Unfolded {
    type Target = Definition;

    fn deref(&self) -> &Definition {
        &self.definition
    }
}

impl Mission {
    /// Reads a mission file. `source_name` is its name in messages. A mission over a floor needs
    /// [`Mission::parse_on`].
    ///
    /// # Errors
    /// All errors of the file, with their places; of one that names a floor that there is none.
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        let robot = Self::robot_of(text).and_then(|it| RobotFile::shipped(&it));
        Self::parse_under(source_name, text, robot)
    }

    /// Returns the name of the robot that a file of [`FORMAT_2`] names.
    pub fn robot_of(text: &str) -> Option<String> {
        lowering::named(text)
    }

    /// Reads a mission file whose robot was read before: the one that a file of [`FORMAT_2`] names,
    /// or one whose supervisors are to decide in a plain mission of [`FORMAT`]. A mission over a
    /// floor needs [`Mission::parse_on`].
    ///
    /// # Errors
    /// All errors of the file, with their places; for a plain mission also that it is not plain, of
    /// one that names a floor that there is none.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_models::robots::RobotFile;
    /// let patrol = embedded::mission("patrol").unwrap();
    /// let robot = RobotFile::shipped("transport");
    /// let mission = Mission::parse_under(patrol.name, patrol.text, robot).unwrap();
    /// assert_eq!(mission.robot().unwrap().robot().name, "transport");
    /// assert!(mission.is_supervised());
    /// ```
    pub fn parse_under(
        source_name: &str,
        text: &str,
        robot: Option<RobotFile>,
    ) -> Result<Self, MissionErrors> {
        Self::parse_on(source_name, text, robot, None)
    }

    /// Reads a mission file, with the way that its floor answers to [what it asks](super::Asked);
    /// of a mission that names no floor, the way is not looked at.
    ///
    /// # Errors
    /// All errors of the file, with their places; also those of the way.
    pub fn parse_on(
        source_name: &str,
        text: &str,
        robot: Option<RobotFile>,
        way: Option<&Way>,
    ) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let axed = is_axed(text);
        let definition = if of_robot(text).is_some() {
            let robot = robot.as_ref();
            let format = if axed { FORMAT_3 } else { FORMAT_2 };
            reader::document(text, &sink, format, |root| {
                reader::definition_of(root, robot, way, axed)
            })
        } else {
            let format = if axed { FORMAT_3 } else { FORMAT };
            let plain = reader::document(text, &sink, format, |it| reader::definition(it, axed));
            plain.and_then(|it| Under::given(it, robot, &sink))
        };
        let definition = definition.filter(|_| sink.is_empty());
        let definition =
            if axed { definition.and_then(|it| axed::read(it, text, &sink)) } else { definition };
        let mut errors = sink.into_diagnostics();
        if let Some(definition) = definition {
            match Unfolded::checked(definition) {
                Ok(unfolded) => {
                    let (source, text) = (source_name.into(), text.into());
                    return Ok(Self { source, text, unfolded });
                }
                Err(found) => errors.extend(found),
            }
        }
        Err(MissionErrors::new(source_name, text, errors))
    }

    /// Returns the name of the file that the mission was read from, as in messages.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Returns the text of the file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the mission with other limits on duration (ms) and energy (mJ), where given, in its
    /// text as well.
    ///
    /// # Errors
    /// All errors of that text: a limit that no file may have.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// let patrol = embedded::mission("patrol").unwrap();
    /// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    /// let poor = mission.with_limits([None, Some(4_320_000)]).unwrap();
    /// assert_eq!(poor.limits, [600_000, 4_320_000]);
    /// assert!(poor.text().contains("energy_mj = 4320000"));
    /// ```
    pub fn with_limits(&self, limits: [Option<u64>; 2]) -> Result<Self, MissionErrors> {
        let Unfolded { definition, scenario } = &self.unfolded;
        let constraints = definition.axes.is_some().then(|| ends::limiting(&scenario.ends));
        let missing = constraints.iter().flatten().zip(limits).zip(AXES);
        let missing =
            missing.filter(|((constraint, limit), _)| constraint.is_none() && limit.is_some());
        let missing = missing.map(|(_, axis)| {
            let message = format!("no end constraint of this mission limits its {axis}");
            Diagnostic::new(0..0, message, "").help("add one to change its goal")
        });
        let missing: Vec<_> = missing.collect();
        if !missing.is_empty() {
            return Err(MissionErrors::new(&self.source, &self.text, missing));
        }
        let text = reader::with_limits(&self.text, limits, constraints);
        Self::parse_on(&self.source, &text, self.robot().cloned(), self.way.as_ref())
    }
}

impl Unfolded {
    /// The whole of a definition, or what is wrong with it as a whole.
    fn checked(definition: Definition) -> Result<Self, Vec<Diagnostic>> {
        let scenario = Scenario::generate(&definition)?;
        let Scenario { limits, order, .. } = scenario;
        let definition = Definition { limits, order, ..definition };
        supervised::check(&definition)?;
        Ok(Self { definition, scenario })
    }

    /// Returns the objectives as steps of a global supervisor.
    pub fn steps(&self) -> Vec<Step> {
        supervised::steps(&self.definition.objectives)
    }

    /// The robot from a file whose supervisors decide, if it is one.
    pub fn robot(&self) -> Option<&RobotFile> {
        self.definition.under.as_ref().map(|it| &it.file)
    }

    /// Whether supervisors decide while it runs.
    pub fn is_supervised(&self) -> bool {
        self.definition.under.is_some()
    }

    /// The activities and their alternatives.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// Returns the alternatives with the speeds that axes allow when only this hardware works;
    /// `None` where speeds do not follow from it.
    pub fn slowed(&self, available: Equipment) -> Option<Slowed> {
        slowed(&self.definition, &self.scenario.activities, available)
    }

    /// Returns a mission with axes as one of the planner of any axes, on its robot and its path.
    pub fn case(&self) -> Option<cotama_axes::Case> {
        let case = self.definition.axes.as_ref()?;
        let derived = Derived::of(&self.definition, self.available()).ok()??;
        Some(cotama_axes::Case { mission: derived.mission, ..(**case).clone() })
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
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// let patrol = embedded::mission("patrol").unwrap();
    /// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    /// let stands = mission.objectives.iter().position(|it| !it.travels()).unwrap();
    /// assert_eq!(mission.without_objective(stands).unwrap().objectives.len(), 8);
    /// // The way to the first valve and all that follows it: nothing would be left.
    /// assert_eq!(mission.without_objective(0), None);
    /// ```
    pub fn without_objective(&self, objective: usize) -> Option<Self> {
        let mut definition = self.definition.clone();
        let dropped = definition.objectives.get(objective)?;
        if dropped.travels() {
            definition.path_length = dropped.x_start;
            definition.objectives.truncate(objective);
            definition.run.faults.events.retain(|event| event.x <= definition.path_length);
            let end = definition.path_length;
            let on_path = |when| !matches!(when, Moment::Place(x) if x > end);
            definition.run.faults.of_robot.retain(|incident| on_path(incident.when));
        } else {
            definition.objectives.remove(objective);
        }
        if definition.objectives.is_empty() { None } else { Self::again(definition) }
    }

    fn again(definition: Definition) -> Option<Self> {
        Self::checked(definition).ok()
    }
}
