//! How a mission is run.

use cotama_core::monitor::Upward;
use cotama_core::units::Millis;
use cotama_models::missions::faults::Faults;
use serde::{Deserialize, Serialize};

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
    /// What goes wrong.
    pub faults: FaultChoice,
    /// How often margins are checked: at least 1 ms; the mission's own period if none.
    pub monitor_period: Option<Millis>,
    /// Who plans.
    pub planner: Planner,
    /// When better plans are looked for; never if none. Growth and reserve are ms and mJ.
    pub upward: Option<Upward<2>>,
}

/// What goes wrong in a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum FaultChoice {
    /// What the mission's own `[run]` says.
    #[default]
    Script,
    /// Nothing, and power is as modelled.
    None,
    /// These faults, in place of the mission's own.
    Given {
        /// Where they come from, for people.
        source: String,
        /// The faults.
        faults: Faults,
    },
}

/// Who plans.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::{Aim, FaultChoice, Options, Planner};
/// use cotama_sim::setup::Simulation;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let used = |planner| {
///     let options = Options { planner, faults: FaultChoice::None, ..Options::default() };
///     Simulation::new(&mission, &options).unwrap().run(0).unwrap().used
/// };
/// assert_eq!(used(Planner::Panorama), [527_923, 8_563_598]);
/// let exact = |aim| Planner::Exact { aim, steps: 100_000 };
/// assert_eq!(used(exact(Aim::Quality)), [527_923, 8_627_497]);
/// assert_eq!(used(exact(Aim::MinEnergy))[1], 4_675_898);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case")]
pub enum Planner {
    /// The paper's rule alone, which can miss a plan.
    #[default]
    Panorama,
    /// The paper's rule and, where it finds nothing, a complete search for the plan that is highest
    /// on the axis treated last.
    PanoramaThenExact {
        /// The most steps of one search.
        steps: u64,
    },
    /// A complete search.
    Exact {
        /// What a plan is chosen for.
        aim: Aim,
        /// The most steps of one search.
        steps: u64,
    },
}

/// What a plan is chosen for by a complete search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// The most quality; of these plans the one that needs the least energy.
    Quality,
    /// The least energy; of these plans the one of the most quality.
    MinEnergy,
}
