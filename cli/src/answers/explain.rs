//! The answer of `cotama explain`.

pub(crate) mod bids;

use super::axes::{DroppedRow, InducerRow};
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama explain`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ExplainAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/explain/1")))]
    pub(crate) schema: &'static str,
    /// The name of the mission.
    pub(crate) mission: String,
    /// For each activity that is asked for, why its candidates are not faster.
    pub(crate) because: Vec<BecauseRow>,
    /// Says that a limit of the work was reached, and activities or candidates are missing.
    pub(crate) limit_reached: bool,
}

/// An activity and its candidates.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BecauseRow {
    /// As `A9`.
    pub(crate) activity: String,
    pub(crate) objective: String,
    pub(crate) x_start_mm: i64,
    pub(crate) x_end_mm: i64,
    /// The zones that cover it.
    pub(crate) zones: Vec<String>,
    /// Combinations of options that constraints leave.
    pub(crate) candidates: Vec<CandidateRow>,
    /// Combinations that a constraint removed.
    pub(crate) dropped: Vec<DroppedRow>,
}

/// A candidate and what holds its speed.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CandidateRow {
    /// As `M5 L2`.
    pub(crate) options: String,
    /// Zero where the robot stands.
    pub(crate) speed_mm_s: i64,
    /// The next speed; none where the robot itself is no faster, or stands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) next_mm_s: Option<i64>,
    /// Core constraints that bound the speed, or would if others did not.
    pub(crate) constraints: Vec<HeldRow>,
}

/// A core constraint on a candidate.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct HeldRow {
    pub(crate) constraint: String,
    /// The highest speed, in whole mm/s, that it allows alone.
    pub(crate) alone_mm_s: i64,
    /// Says that the next speed breaks it.
    pub(crate) binds: bool,
    /// What is known of one that binds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) binding: Option<BindingRow>,
}

/// How a constraint binds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BindingRow {
    /// The unit of values and goal.
    pub(crate) unit: String,
    /// The value of its indicator at the speed.
    pub(crate) value: i64,
    /// The value at the next speed.
    pub(crate) value_next: i64,
    /// As `<`.
    pub(crate) relation: &'static str,
    /// The goal here, which the value at the next speed misses.
    pub(crate) goal: i64,
    /// Inducers on which the value hangs.
    pub(crate) inducers: Vec<InducerRow>,
    /// Changes of one number after which it allows the next speed; of one activity alone.
    pub(crate) raises: Vec<RaiseRow>,
}

/// A change of one number.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RaiseRow {
    /// As `robot.mass_g`, `laser.detect_ms`, `H1-out.width_mm`, `L2.frames`, or `goal`.
    pub(crate) name: String,
    pub(crate) now: i64,
    /// The nearest number at which the constraint allows the next speed.
    pub(crate) needed: i64,
    /// The candidate's speed with it; today's where another constraint holds it too, zero where
    /// one removes it then.
    pub(crate) speed_mm_s: i64,
}
