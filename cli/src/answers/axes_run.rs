//! The answer of `cotama run` for a mission with performance axes of its own.

use super::axes::TotalRow;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama run` for a mission with axes.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AxesRunAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/run-axes/1")))]
    pub(crate) schema: &'static str,
    /// The name of the mission.
    pub(crate) mission: String,
    /// The end of the mission.
    pub(crate) outcome: AxesOutcome,
    /// The end constraint that does not hold, where one is the cause.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) constraint: Option<String>,
    /// When it ended, ms after the start.
    pub(crate) t_ms: i64,
    /// The place on the path at which it ended.
    pub(crate) x_mm: i64,
    /// The sums that were used.
    pub(crate) used: Vec<TotalRow>,
    /// Margins of end constraints at the end, in the order of treatment.
    pub(crate) margins: Vec<MarginRow>,
    /// Plans, the first of the start; none if the robot never left.
    pub(crate) plans: Vec<AxesPlanRow>,
    /// The place at which the robot turned round to go home.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) turned: Option<MomentRow>,
    /// The place at which the robot took the cheapest safe options to the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hurried: Option<MomentRow>,
}

/// The end of a mission with axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub(crate) enum AxesOutcome {
    /// All is done, and all end constraints hold.
    Completed,
    /// All is done, and an end constraint does not hold.
    Missed,
    /// The robot turned round and is home.
    Returned,
    /// The robot stands on the way: no plan is left.
    Stopped,
    /// The robot stands on the way: it used up what an end constraint leaves.
    Stranded,
    /// There is no plan at the start, or no return: the robot stays where it is.
    Infeasible,
    /// A limit of the search was reached at the start.
    Unknown,
}

/// The margin of an end constraint.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MarginRow {
    pub(crate) constraint: String,
    pub(crate) unit: String,
    /// The goal less what was used; of an `at least` what was reached less the goal.
    pub(crate) value: i64,
}

/// A moment of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MomentRow {
    pub(crate) t_ms: i64,
    pub(crate) x_mm: i64,
}

/// A plan of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AxesPlanRow {
    pub(crate) t_ms: i64,
    pub(crate) x_mm: i64,
    /// `start`, `margin of CONSTRAINT`, or `HARDWARE lost`.
    pub(crate) cause: String,
    /// The choice for each activity from here on.
    pub(crate) choices: Vec<ChoiceRow>,
}

/// The choice for an activity.
#[derive(Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ChoiceRow {
    pub(crate) objective: String,
    pub(crate) x_start_mm: i64,
    /// As `M5 L2`.
    pub(crate) options: String,
    /// Zero where the robot stands.
    pub(crate) speed_mm_s: i64,
}

/// The margin of a sum beyond duration and energy.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct FurtherMargin {
    /// The end constraint.
    pub(crate) constraint: String,
    /// In the unit of the indicator.
    pub(crate) margin: i64,
}
