//! The answer of `cotama estimate`.

use super::campaign::Measured;
use super::check::{FiringRow, RestRow, VerdictName};
use crate::args::Semantics;
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama estimate`.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct EstimateAnswer {
    #[schemars(extend("const" = "cotama/estimate/1"))]
    pub(crate) schema: &'static str,
    /// The name or path of the model.
    pub(crate) model: String,
    /// What it means that its nets work together; of a system.
    pub(crate) semantics: Option<Semantics>,
    /// What to know about the model as it is asked.
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

/// What is known of a property.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct EstimateRow {
    /// As on the command line.
    pub(crate) property: String,
    /// What one of the runs shows for certain; else it is not known.
    pub(crate) verdict: VerdictName,
    /// The probability that a run of so many steps is as the property says, where each enabled
    /// transition is equally likely to fire.
    pub(crate) probability: Measured,
    /// How many runs were so.
    pub(crate) holding: u64,
    /// Of how many runs more steps could have shown otherwise.
    pub(crate) open: u64,
    /// The number of the shortest run that shows the verdict.
    pub(crate) run: Option<u64>,
    /// Why it shows it.
    pub(crate) cause: Option<String>,
    /// What fires in it.
    pub(crate) trace: Option<Vec<FiringRow>>,
    /// How it goes on.
    pub(crate) rest: Option<RestRow>,
}
