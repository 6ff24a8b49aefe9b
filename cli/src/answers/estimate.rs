//! The answer of `cotama estimate`.

use super::check::{FiringRow, RestRow, VerdictName};
use crate::args::Semantics;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama estimate`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct EstimateAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/estimate/1")))]
    pub(crate) schema: &'static str,
    /// The name or path of the model.
    pub(crate) model: String,
    /// Meaning of a system of nets; of a system alone.
    pub(crate) semantics: Option<Semantics>,
    /// Notes on the model as it is asked.
    pub(crate) notes: Vec<String>,
    /// How many runs were drawn.
    pub(crate) runs: u64,
    /// The most transitions that a run fires.
    pub(crate) steps: u64,
    /// The seed of all draws.
    pub(crate) seed: u64,
    pub(crate) results: Vec<EstimateRow>,
    /// How many transitions fired in all runs.
    pub(crate) fired: u64,
    /// How long drawing took.
    pub(crate) seconds: f64,
}

/// The estimate of a property.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct EstimateRow {
    /// As on the command line.
    pub(crate) property: String,
    /// Verdict that one of the runs shows for certain; else unknown.
    pub(crate) verdict: VerdictName,
    /// The probability that a run of so many steps is as the property says, where each enabled
    /// transition is equally likely to fire.
    pub(crate) probability: Measured,
    /// How many runs were so.
    pub(crate) holding: u64,
    /// Number of runs that could have shown otherwise with more steps.
    pub(crate) open: u64,
    /// The number of the shortest run that shows the verdict.
    pub(crate) run: Option<u64>,
    /// Why it shows it.
    pub(crate) cause: Option<String>,
    /// Firings of the run.
    pub(crate) trace: Option<Vec<FiringRow>>,
    /// How it goes on.
    pub(crate) rest: Option<RestRow>,
}

/// An estimate with its interval: exact (Clopper and Pearson) for probabilities after a number of
/// runs that was fixed before.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Measured {
    pub(crate) estimate: f64,
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// How often such an interval holds the truth, at least.
    pub(crate) confidence: f64,
}
