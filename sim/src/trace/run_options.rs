//! Options of a run of a mission, as its trace keeps them.

use super::{Used, pose};
use crate::options::{Fidelity, Planner};
use serde::{Deserialize, Serialize};

/// Options of a run of a mission.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunOptions {
    /// The seed of all random numbers.
    pub seed: u64,
    /// The faults.
    pub faults: RunFaults,
    /// How often margins were checked, in ms.
    pub monitor_period_ms: u64,
    /// The planner.
    pub allocator: Planner,
    /// Whether the plan of the start was kept, whatever became of the margins.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub rigid: bool,
    /// When better plans were looked for; never if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upward: Option<RunUpward>,
    /// How closely the robot was modelled.
    #[serde(default, skip_serializing_if = "Fidelity::is_line")]
    pub fidelity: Fidelity,
    /// How many people walked on the floor.
    #[serde(default, skip_serializing_if = "pose::is_none")]
    pub people: usize,
    /// The text of a measurement by which failures were found; absent where latencies were assumed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<String>,
    /// The text of the margins that were held back; absent where none were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margins: Option<String>,
}

/// The faults of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "mode", rename_all = "snake_case")]
pub enum RunFaults {
    /// The faults of the mission's own `[run]`.
    Script,
    /// No faults, and power as modelled.
    None,
    /// The faults of a `panorama-faults/1` text.
    File {
        /// The name of its source.
        source: String,
        /// The whole text.
        text: String,
    },
}

/// When better plans are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunUpward {
    /// How much a margin must have grown since the last plan; zero: not on this axis.
    pub growth: Used,
    /// Amounts that a better plan leaves unspent.
    pub reserve: Used,
}
