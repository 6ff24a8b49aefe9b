//! How a mission is run.

use cotama_core::monitor::Upward;
use cotama_core::units::Millis;
use cotama_models::missions::faults::Faults;
use serde::{Deserialize, Serialize};

/// How a mission is run.
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
