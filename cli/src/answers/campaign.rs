//! The answer of `cotama campaign`.

use super::estimate::Measured;
use super::risk::HeldAnswer;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama campaign` and of `cotama campaign merge`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CampaignAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/campaign/1")))]
    pub(crate) schema: &'static str,
    /// The name of the mission.
    pub(crate) mission: String,
    /// How many missions were run, in this shard if it is one.
    pub(crate) runs: u64,
    /// The seed of all draws.
    pub(crate) seed: u64,
    /// How plans were drawn.
    pub(crate) strategy: String,
    /// How plans were adapted.
    pub(crate) policy: String,
    /// Planner and adaptation, in words.
    pub(crate) planner: String,
    /// Which part of the campaign this is, as `2/3`; none for the whole.
    pub(crate) shard: Option<String>,
    pub(crate) outcomes: Outcomes,
    /// How many runs broke a requirement.
    pub(crate) failing: u64,
    /// The probability that a run breaks a requirement, of plans drawn as these were; none where
    /// they were not drawn independently. After a sequential test the interval is one that holds
    /// whenever runs end.
    pub(crate) failure_probability: Option<Measured>,
    /// The same for each requirement.
    pub(crate) requirements: Vec<RequirementRow>,
    /// Causes of failures, the most frequent first; none in a shard.
    pub(crate) failures: Vec<FailureRow>,
    /// How many failing runs were made small.
    pub(crate) shrunk: u64,
    /// How many runs that took in all.
    pub(crate) shrinking_runs: u64,
    /// Decision of a sequential test.
    pub(crate) decision: Option<DecisionRow>,
    /// Margins that were held back, and how often runs passed them; with margins alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) held: Option<HeldAnswer>,
    /// A digest of the lines of results: equal for equal results.
    pub(crate) digest: String,
    /// The policies over the same plans, with `--compare`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) policies: Vec<PolicyRow>,
    /// The page, if one was written.
    pub(crate) report: Option<String>,
}

/// How many runs ended how.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Outcomes {
    pub(crate) completed: u64,
    pub(crate) safe: u64,
    pub(crate) failed: u64,
}

/// A requirement of every run, with its counts.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RequirementRow {
    /// As on the command line.
    pub(crate) requirement: String,
    /// In words.
    pub(crate) text: String,
    /// How many runs broke it.
    pub(crate) violated: u64,
    pub(crate) probability: Option<Measured>,
}

/// Failing runs with one cause.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct FailureRow {
    /// The file that replays it, if it was written.
    pub(crate) fault_file: Option<String>,
    /// The requirement that it breaks.
    pub(crate) requirement: String,
    /// The faults of the cause.
    pub(crate) signature: String,
    /// How many of the runs that were made small have this cause.
    pub(crate) count: u64,
    /// The first of them.
    pub(crate) run: u64,
    /// The file's text.
    pub(crate) scenario: String,
}

/// The decision of a sequential test.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DecisionRow {
    /// `at_most`, `more`, or `undecided`.
    pub(crate) verdict: &'static str,
    /// The probability that was asked about.
    pub(crate) at_most: f64,
    /// From here on it is called more; between both, either answer is right.
    pub(crate) more_from: f64,
    pub(crate) confidence: f64,
    /// After how many runs.
    pub(crate) runs: u64,
    /// Whether every plan that there is was run and counted: then it is certain.
    pub(crate) exact: bool,
}

/// A mean over the plans that were run, with the interval for all that are drawn so; no interval
/// where plans were not drawn independently.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Mean {
    pub(crate) estimate: f64,
    pub(crate) low: Option<f64>,
    pub(crate) high: Option<f64>,
    /// How often such an interval holds the truth, at least.
    pub(crate) confidence: Option<f64>,
}

/// A policy over the same plans.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PolicyRow {
    pub(crate) policy: &'static str,
    pub(crate) outcomes: Outcomes,
    /// The probability that a mission is completed; none where plans were not drawn independently.
    pub(crate) success: Option<Measured>,
    /// How much more likely it is completed than with the first policy; none for the first, nor
    /// where plans were not drawn independently.
    pub(crate) success_difference: Option<Measured>,
    /// How likely so large a difference is if there is none (`McNemar`'s exact test).
    pub(crate) p_value: Option<f64>,
    pub(crate) duration_ms: Mean,
    pub(crate) energy_mj: Mean,
    pub(crate) operator_requests: Mean,
    pub(crate) replans: Mean,
}
