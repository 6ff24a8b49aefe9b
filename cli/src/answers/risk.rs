//! The answers of `cotama risk`.

use super::estimate::Measured;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// The answer of `cotama risk learn`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct LearnAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/risk-learn/1")))]
    pub(crate) schema: &'static str,
    /// Rows of the data.
    pub(crate) rows: u64,
    /// `bic` or `bdeu`.
    pub(crate) score: &'static str,
    /// The equivalent sample size of `bdeu`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) ess: Option<f64>,
    /// The score of the graph; higher is better, natural logarithms.
    pub(crate) value: f64,
    /// `exact`, `hill`, `k2` or `mcmc`; `hill` where the limit of `exact` was reached.
    pub(crate) method: &'static str,
    /// `optimal`, `local`, `given order` or `none`.
    pub(crate) proof: &'static str,
    /// No graph scores higher than this; of a graph that is not optimal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) bound: Option<f64>,
    /// The limit that was reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) limit: Option<String>,
    /// The order that was given, else one in which parents stand before their children.
    pub(crate) order: Vec<String>,
    /// The bound of the parents of a variable; null without one.
    pub(crate) max_parents: Option<u64>,
    /// For each column its parents.
    pub(crate) parents: BTreeMap<String, Vec<String>>,
    /// Arcs that all graphs of the class have: others could point the other way.
    pub(crate) compelled: Vec<[String; 2]>,
    /// Columns with one state only.
    pub(crate) constant: Vec<String>,
    /// Bytes that exact search took at most, stated before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) memory_bytes: Option<u64>,
    /// Accepted over refused steps of `mcmc`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) acceptance: Option<f64>,
    /// Arcs of graphs that were learned of resampled rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) bootstrap: Option<BootstrapAnswer>,
}

/// How often arcs came back in graphs of resampled rows.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BootstrapAnswer {
    pub(crate) resamples: u64,
    /// Arcs that at least one of these graphs has, by the order of the columns.
    pub(crate) arcs: Vec<ArcRow>,
}

/// An arc of graphs of resampled rows.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ArcRow {
    pub(crate) from: String,
    pub(crate) to: String,
    /// Share of the graphs with this arc.
    pub(crate) share: f64,
    /// Share of the graphs in which an arc joins the two, in either direction.
    pub(crate) joined: f64,
}

/// The answer of `cotama risk infer`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct InferAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/risk-infer/1")))]
    pub(crate) schema: &'static str,
    pub(crate) query: String,
    /// Variables with the states that are known.
    pub(crate) evidence: BTreeMap<String, String>,
    pub(crate) probability_of_evidence: f64,
    /// For each state of the query its probability.
    pub(crate) posterior: BTreeMap<String, f64>,
    /// Evidence that cannot tell anything of the query, given the rest.
    pub(crate) without_influence: Vec<String>,
}

/// The answer of `cotama risk coherence`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CoherenceAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/risk-coherence/1")))]
    pub(crate) schema: &'static str,
    pub(crate) network: String,
    /// The network was learned of data.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) learned: Option<LearnedFrom>,
    /// All pairs of variables, the most coherent first.
    pub(crate) pairs: Vec<CoherentRow>,
}

/// The data of which a network was learned.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct LearnedFrom {
    pub(crate) rows: u64,
    /// Columns of measurements, which were cut into steps of equal frequency.
    pub(crate) cut: Vec<String>,
    /// Steps of each of these.
    pub(crate) bins: u64,
    /// `optimal`, or `local` where there are too many variables to search all graphs.
    pub(crate) proof: &'static str,
}

/// Two variables.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CoherentRow {
    pub(crate) x: String,
    pub(crate) y: String,
    /// Mutual information.
    pub(crate) information_nats: f64,
    /// Joint entropy.
    pub(crate) entropy_nats: f64,
    /// Information over entropy.
    pub(crate) eta: f64,
}

/// The answer of `cotama risk discretise`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DiscretiseAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/risk-discretise/1")))]
    pub(crate) schema: &'static str,
    pub(crate) rows: u64,
    /// Columns that were cut.
    pub(crate) columns: Vec<CutRow>,
    /// Columns that stay as they are.
    pub(crate) kept: Vec<String>,
    /// The new data as CSV, unless it was written into a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) csv: Option<String>,
}

/// A column that was cut.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CutRow {
    pub(crate) name: String,
    /// Cuts, rising; a step goes up to a cut, but without it.
    pub(crate) cuts: Vec<f64>,
    /// Rows of each step.
    pub(crate) counts: Vec<u64>,
}

/// The answer of `cotama risk separated`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct SeparatedAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/risk-separated/1")))]
    pub(crate) schema: &'static str,
    pub(crate) x: String,
    pub(crate) y: String,
    pub(crate) given: Vec<String>,
    pub(crate) separated: bool,
    /// The variables of an open path; empty where there is none.
    pub(crate) path: Vec<String>,
    /// Between each two of these the arc, `->` or `<-`.
    pub(crate) arcs: Vec<&'static str>,
}

/// The answer of `cotama risk choose`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ChooseAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/risk-choose/1")))]
    pub(crate) schema: &'static str,
    /// `mean`, or the level of a quantile.
    pub(crate) measure: String,
    /// `thesis`, `exact` or `total`.
    pub(crate) rule: &'static str,
    /// Trials left.
    pub(crate) trials: u64,
    /// For each state of the hidden variable its probability now.
    pub(crate) belief: BTreeMap<String, f64>,
    /// For each way the cost of beginning with it, the best ways after it.
    pub(crate) costs: BTreeMap<String, f64>,
    /// The way to take.
    pub(crate) choice: String,
    /// The utility less its cost.
    pub(crate) reward: f64,
    /// By `total` the ways of all trials.
    pub(crate) sequence: Vec<String>,
}

/// The answer of `cotama risk calibrate`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CalibrateAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/risk-calibrate/1")))]
    pub(crate) schema: &'static str,
    /// Name of the mission.
    pub(crate) mission: String,
    /// Runs of the table.
    pub(crate) runs: u64,
    /// How often a rest is to stay within its bound, at least.
    pub(crate) coverage: f64,
    /// Bounds that were learned, for each activity; none with `--against`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) promises: Vec<PromiseRow>,
    /// The file of margins that was held against the runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) against: Option<String>,
    /// Promises held against later runs, for each activity and axis.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) watched: Vec<WatchedRow>,
    /// Whether the calibration holds, as far as these runs say; none where one was learned. An
    /// alarm is wrong at most once in 1,000 tables.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) holds: Option<bool>,
}

/// A bound of all that follows the start of an activity.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PromiseRow {
    pub(crate) activity: String,
    /// Runs that came there.
    pub(crate) runs: u32,
    /// Rank of the ratio that is the bound, from 1 for the smallest; none where they are too few.
    pub(crate) rank: Option<u32>,
    /// The share of further runs within the bound: its mean over all sets of runs, and an interval
    /// for the share of this one.
    pub(crate) coverage: Option<Measured>,
    pub(crate) duration: DriftRow,
    pub(crate) energy: DriftRow,
}

/// Ratios of what is used over what is planned; none where too many runs did not come to the end,
/// or were too few.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DriftRow {
    /// The bound of all from this activity on.
    pub(crate) rest: Option<f64>,
    /// The bound of this activity by itself.
    pub(crate) alone: Option<f64>,
    /// The median of this activity by itself.
    pub(crate) median: Option<f64>,
}

/// A bound held against later runs.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct WatchedRow {
    pub(crate) activity: String,
    /// `duration` or `energy`.
    pub(crate) axis: &'static str,
    /// Runs that came there.
    pub(crate) runs: u64,
    /// Runs that passed the bound, or did not come to the end.
    pub(crate) missed: u64,
    /// Their share, with its exact interval.
    pub(crate) missed_share: Measured,
    /// The share that was promised within the bound, with an interval for that of one set of past
    /// runs.
    pub(crate) promised: Measured,
    /// After how many of these runs it was clear that more pass the bound than promised.
    pub(crate) broken_after: Option<u64>,
}

/// Margins that were held back in a run or a campaign, and what its runs made of their promise.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct HeldAnswer {
    /// How often a rest is to stay within its bound, at least.
    pub(crate) coverage: f64,
    /// Whether the calibration holds, as far as these runs say. An alarm is wrong at most once in
    /// 1,000 times.
    pub(crate) holds: bool,
    /// The promises, for each activity and axis.
    pub(crate) watched: Vec<WatchedRow>,
}
