//! The answers of `cotama risk`.

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
    /// All pairs of variables, the most coherent first.
    pub(crate) pairs: Vec<CoherentRow>,
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
