//! How a mission is run.

use cotama_core::monitor::Upward;
use cotama_core::units::Millis;
use cotama_models::margins::Calibration;
use cotama_models::missions::faults::{FIDELITIES, Faults};
use cotama_models::missions::{Definition, PlannedFor};
use cotama_models::robots::Measurement;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How a mission is run.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::{FaultChoice, Options};
/// use cotama_sim::setup::Simulation;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let options = Options { faults: FaultChoice::None, ..Options::default() };
/// let run = Simulation::new(&mission, &options).unwrap().run(0).unwrap();
/// // Planned are 527,924 ms and 8,563,613 mJ, where each activity is rounded.
/// assert_eq!((run.replans, run.events.total(), run.used), (0, 0, [527_923, 8_563_598]));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The seed of all random numbers.
    pub seed: u64,
    /// The faults.
    pub faults: FaultChoice,
    /// How often margins are checked: at least 1 ms; the mission's own period if none.
    pub monitor_period: Option<Millis>,
    /// The planner; [that of the mission](Planner::of) if `None`.
    pub planner: Option<Planner>,
    /// Keeps the plan of the start whatever becomes of the margins: what adaptation is compared
    /// with.
    pub rigid: bool,
    /// When better plans are looked for; never if none. Growth and reserve are ms and mJ.
    pub upward: Option<Upward<2>>,
    /// How closely the robot is modelled.
    pub fidelity: Fidelity,
    /// How many people walk on the floor, in the plane.
    pub people: usize,
    /// How failures of the robot are found: as they were measured, in place of the latencies that
    /// its file assumes. By signals nothing is told, and this is not looked at.
    pub measured: Option<Arc<Measurement>>,
    /// How much is held back for what remains; nothing, as in the paper, if none.
    pub margins: Option<Arc<Calibration>>,
}

/// How closely a robot is modelled. Supervisors, plans and faults are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fidelity {
    /// A point on its path.
    #[default]
    Line,
    /// Two wheels that follow the path over a floor, with a pose that is known.
    Plane,
    /// The same by signals: the robot knows what its devices read, and flags come of signals.
    Signal,
}

impl Fidelity {
    /// All, in the order of their names in files.
    pub const ALL: [Self; 3] = [Self::Line, Self::Plane, Self::Signal];

    /// Returns the name in files: `line`, `plane`, `signal`.
    pub fn name(self) -> &'static str {
        FIDELITIES[self as usize % FIDELITIES.len()]
    }

    /// Whether it is on a line, which files need not say.
    #[allow(clippy::trivially_copy_pass_by_ref)] // as serde asks
    pub fn is_line(&self) -> bool {
        *self == Self::Line
    }
}

/// When better plans are looked for, where they are: when a margin has grown by a hundredth of its
/// limit; a better plan leaves half of that.
pub fn upward(limits: [u64; 2]) -> Upward<2> {
    Upward {
        growth: limits.map(|limit| (limit / 100).max(1)),
        reserve: limits.map(|limit| limit / 200),
    }
}

/// The faults of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum FaultChoice {
    /// The faults of the mission's own `[run]`.
    #[default]
    Script,
    /// Nothing, and power is as modelled.
    None,
    /// These faults, in place of the mission's own.
    Given {
        /// Source of the faults, for people.
        source: String,
        /// The faults.
        faults: Faults,
    },
}

/// The planner of a run.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::{Aim, FaultChoice, Options, Planner};
/// use cotama_sim::setup::Simulation;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let used = |planner| {
///     let planner = Some(planner);
///     let options = Options { planner, faults: FaultChoice::None, ..Options::default() };
///     Simulation::new(&mission, &options).unwrap().run(0).unwrap().used
/// };
/// assert_eq!(used(Planner::Panorama), [527_923, 8_563_598]);
/// let exact = |aim| Planner::Exact { aim, steps: 100_000 };
/// assert_eq!(used(exact(Aim::Quality)), [527_923, 8_627_497]);
/// assert_eq!(used(exact(Aim::MinEnergy))[1], 4_675_898);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case")]
pub enum Planner {
    /// The paper's rule alone, which can miss a plan.
    Panorama,
    /// The paper's rule and, where it finds nothing, a complete search for the plan that is highest
    /// on the axis treated last.
    PanoramaThenExact {
        /// The most steps of one search.
        steps: u64,
    },
    /// A complete search.
    Exact {
        /// The objective of a plan.
        aim: Aim,
        /// The most steps of one search.
        steps: u64,
    },
}

/// The objective of a complete search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// The most quality; of these plans the one that needs the least energy.
    Quality,
    /// The least energy; of these plans the one of the most quality.
    MinEnergy,
}

/// The most steps of one complete search, unless it is said otherwise.
pub const STEPS: u64 = 50_000_000;

/// The maker of a plan: PANORAMA's rule, or a complete search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// The rule, which pursues no objective of its own.
    Panorama,
    /// A complete search; for the objective of the paper only where the rule finds nothing.
    Exact,
}

impl By {
    /// Returns the name on the command line and in files: `panorama`, `exact`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Panorama => "panorama",
            Self::Exact => "exact",
        }
    }
}

impl Planner {
    /// Returns the planner of a mission in every command, unless another one is named: that of its
    /// `[plan]`, else a complete search for the most quality.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_sim::options::{Aim, Planner, STEPS};
    /// let of = |name: &str| {
    ///     let known = embedded::mission(name).unwrap();
    ///     Planner::of(&Mission::parse(known.name, known.text).unwrap())
    /// };
    /// assert_eq!(of("patrol"), Planner::Panorama);
    /// assert_eq!(of("delivery"), Planner::Exact { aim: Aim::Quality, steps: STEPS });
    /// ```
    pub fn of(mission: &Definition) -> Self {
        Self::chosen(mission.planned_for.unwrap_or(PlannedFor::Quality), None, STEPS)
    }

    /// Returns the planner for an objective: the named one, else the rule for the paper's and a
    /// search for the others.
    pub const fn chosen(objective: PlannedFor, by: Option<By>, steps: u64) -> Self {
        match (objective, by) {
            (PlannedFor::Paper, Some(By::Exact)) => Self::PanoramaThenExact { steps },
            (PlannedFor::Paper, _) | (_, Some(By::Panorama)) => Self::Panorama,
            (PlannedFor::Quality, _) => Self::Exact { aim: Aim::Quality, steps },
            (PlannedFor::MinEnergy, _) => Self::Exact { aim: Aim::MinEnergy, steps },
        }
    }

    /// The objective, who plans and the steps that [`chosen`](Self::chosen) makes it of; the rule
    /// takes no steps of a search.
    pub const fn parts(self) -> (PlannedFor, By, Option<u64>) {
        match self {
            Self::Panorama => (PlannedFor::Paper, By::Panorama, None),
            Self::PanoramaThenExact { steps } => (PlannedFor::Paper, By::Exact, Some(steps)),
            Self::Exact { aim: Aim::Quality, steps } => {
                (PlannedFor::Quality, By::Exact, Some(steps))
            }
            Self::Exact { aim: Aim::MinEnergy, steps } => {
                (PlannedFor::MinEnergy, By::Exact, Some(steps))
            }
        }
    }

    /// In words: `a complete search for the most quality, of at most 50000000 steps`.
    pub fn words(self) -> String {
        match self {
            Self::Panorama => "the paper’s rule".into(),
            Self::PanoramaThenExact { steps } => {
                format!("the paper’s rule, then a complete search of at most {steps} steps")
            }
            Self::Exact { aim, steps } => {
                let aim = match aim {
                    Aim::Quality => "the most quality",
                    Aim::MinEnergy => "the least energy",
                };
                format!("a complete search for {aim}, of at most {steps} steps")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::missions::{Mission, embedded};

    #[test]
    fn the_parts_of_a_planner_make_it_again() {
        let steps = 7;
        let planners = [
            Planner::Panorama,
            Planner::PanoramaThenExact { steps },
            Planner::Exact { aim: Aim::Quality, steps },
            Planner::Exact { aim: Aim::MinEnergy, steps },
        ];
        for planner in planners {
            let (objective, by, steps) = planner.parts();
            assert_eq!(Planner::chosen(objective, Some(by), steps.unwrap_or(1)), planner);
        }
    }

    #[test]
    fn a_mission_is_planned_as_its_file_says_and_else_for_quality() {
        let patrol = embedded::mission("patrol").unwrap().text;
        let with = |plan: &str| {
            let text = patrol.replace("plan.objective = \"paper\"", plan);
            Planner::of(&Mission::parse("own", &text).unwrap())
        };
        let exact = |aim| Planner::Exact { aim, steps: STEPS };
        assert_eq!(with("plan.objective = \"paper\""), Planner::Panorama);
        assert_eq!(with("plan.objective = \"quality\""), exact(Aim::Quality));
        assert_eq!(with("plan.objective = \"min-energy\""), exact(Aim::MinEnergy));
        assert_eq!(with(""), exact(Aim::Quality));
    }
}
