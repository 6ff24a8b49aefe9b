//! The answer of `cotama plan` for a mission with performance axes of its own.

use super::Status;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama plan` for a mission with axes.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AxesAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/plan-axes/1")))]
    pub(crate) schema: &'static str,
    /// The name of the mission.
    pub(crate) mission: String,
    /// The activities, in sequence.
    pub(crate) activities: Vec<AxesActivity>,
    /// How many plans there are, within the limits or not, as a decimal number; `more than 2^128`
    /// beyond that.
    pub(crate) combinations: String,
    /// `optimal`, `infeasible`, or `unknown` where a limit of the search was reached.
    pub(crate) status: Status,
    /// For each activity the options taken together, as `M5 L2`; empty without a plan.
    pub(crate) plan: Vec<String>,
    /// For each activity of the plan its speed; zero where the robot stands.
    pub(crate) speeds_mm_s: Vec<i64>,
    /// The sums of the plan.
    pub(crate) totals: Vec<TotalRow>,
    /// Constraints of which to lift one alone leaves a plan.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) single: Vec<LiftRow>,
    /// Of these the one whose goal needs the least change, relative to it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) blame: Option<String>,
    /// The goal nearest to today's with which the blamed constraint suffices; of a constraint on
    /// the end of the mission alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) needed: Option<i64>,
    /// A least set of constraints which, lifted together, leave a plan, where none does alone.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) correction: Vec<String>,
    /// All such sets, those of one constraint too.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) corrections: Vec<Vec<String>>,
    /// The work done: values of formulas, partial plans looked at.
    pub(crate) steps: u64,
}

/// An activity of a mission with axes.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AxesActivity {
    pub(crate) id: String,
    pub(crate) objective: String,
    pub(crate) x_start_mm: i64,
    pub(crate) x_end_mm: i64,
    /// The candidates that constraints leave.
    pub(crate) candidates: u64,
    /// The candidates before constraints.
    pub(crate) candidates_before: u64,
    /// Zero when it does not travel.
    pub(crate) speed_max_mm_s: i64,
    /// Constraints that the fastest candidate, the first of equals, would break at the next speed;
    /// none where the robot itself is no faster, or stands.
    pub(crate) bounded_by: Vec<BoundRow>,
    /// Combinations of options that are no candidates.
    pub(crate) dropped: Vec<DroppedRow>,
}

/// A constraint that bounds a speed.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BoundRow {
    pub(crate) constraint: String,
    /// The value of its indicator at the speed.
    pub(crate) value: i64,
    /// The value at the next speed.
    pub(crate) value_next: i64,
    /// The goal here, which that value misses.
    pub(crate) goal: i64,
    /// Inducers on which the value hangs.
    pub(crate) inducers: Vec<InducerRow>,
}

/// A parameter that acts on an indicator.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct InducerRow {
    /// As in formulas.
    pub(crate) name: String,
    pub(crate) value: i64,
    /// The zone, the hardware or the options that it is of; empty if that is clear.
    pub(crate) of: String,
}

/// A constraint that suffices alone.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct LiftRow {
    pub(crate) constraint: String,
    /// The goals nearest to today's with which it suffices; none of a constraint that is not on the
    /// end of the mission.
    pub(crate) needed: Vec<i64>,
}

/// A combination of options that is no candidate.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DroppedRow {
    /// As `M3 L1`.
    pub(crate) options: String,
    /// The constraints that speak against it, as `glass.require_tio`, `blind`, or the name of one.
    pub(crate) by: Vec<String>,
}

/// A sum over the mission.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TotalRow {
    /// As `energy.RC`.
    pub(crate) indicator: String,
    pub(crate) unit: String,
    pub(crate) value: i64,
}
