//! The answers about behaviour trees.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama check` about a behaviour tree.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/check-tree/1")))]
    pub(crate) schema: &'static str,
    /// The file.
    pub(crate) model: String,
    /// The tree executed.
    pub(crate) tree: String,
    /// Nodes, with those of subtrees.
    pub(crate) nodes: usize,
    /// Parts that are free or left out.
    pub(crate) notes: Vec<String>,
    /// Warnings about the files.
    pub(crate) warnings: Vec<TreeNoteRow>,
    /// Assumptions that forbade nothing.
    pub(crate) unused_assumptions: Vec<String>,
    /// Whether all states were explored.
    pub(crate) complete: bool,
    /// An answer for each finding, for each question without one, and for each property.
    pub(crate) results: Vec<TreeRow>,
}

/// A message about a place of a file.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeNoteRow {
    pub(crate) file: String,
    /// From 1.
    pub(crate) line: u32,
    /// In characters, from 1.
    pub(crate) column: u32,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
}

/// An answer to one question.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeRow {
    /// Name of the question, as `success-lost`; of an own property `property`.
    pub(crate) name: String,
    /// The wish, or the property as it was given.
    pub(crate) property: String,
    /// `true`, `false` or `unknown`.
    pub(crate) verdict: &'static str,
    /// `error`, `warning` or `note`; none where nothing was found.
    pub(crate) level: Option<&'static str>,
    /// Description of the finding.
    pub(crate) message: Option<String>,
    /// Remedy.
    pub(crate) help: Option<String>,
    /// Labels of the nodes that it is about.
    pub(crate) nodes: Vec<String>,
    /// File of the first of them.
    pub(crate) file: Option<String>,
    /// Line of the first of them, from 1.
    pub(crate) line: Option<u32>,
    /// Column of the first of them.
    pub(crate) column: Option<u32>,
    pub(crate) engine: &'static str,
    /// States explored.
    pub(crate) states: usize,
    pub(crate) seconds: f64,
    /// A run that shows it, with the fewest ticks.
    pub(crate) trace: Option<Vec<TreeTickRow>>,
    /// The tick, from 1, from which on the run repeats for ever.
    pub(crate) repeats_from: Option<usize>,
}

/// A tick of a run.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeTickRow {
    /// From 1.
    pub(crate) tick: usize,
    /// Events, as `cotama conform` reads them.
    pub(crate) events: Vec<String>,
    /// Status of the root, S, F, R, K, an exception, or where the tick stops.
    pub(crate) status: String,
    /// All entries of the blackboards.
    pub(crate) blackboard: String,
    /// Marked places of the supervisor; left out without one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(test, schemars(default))]
    pub(crate) marked: Vec<String>,
}

/// The answer of `cotama conform` about a behaviour tree.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeConformAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/conform-tree/1")))]
    pub(crate) schema: &'static str,
    /// The file of the tree.
    pub(crate) model: String,
    /// The file of the recorded runs.
    pub(crate) trace: String,
    pub(crate) conforms: bool,
    /// Runs accepted.
    pub(crate) runs: usize,
    /// Rows accepted.
    pub(crate) rows: usize,
    /// The first row that differs.
    pub(crate) departs: Option<TreeDepartsRow>,
}

/// The first row that differs.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeDepartsRow {
    /// Line of the trace, from 1.
    pub(crate) line: usize,
    /// `events`, `status`, `blackboard` or `set`.
    pub(crate) column: &'static str,
    /// Text that stands there.
    pub(crate) found: String,
    /// The tree's own text there.
    pub(crate) allowed: String,
    /// A question that the row does not answer.
    pub(crate) asked: Option<String>,
}

/// The answer of `cotama statespace` about a behaviour tree.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeSpaceAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/statespace-tree/1")))]
    pub(crate) schema: &'static str,
    pub(crate) model: String,
    pub(crate) tree: String,
    /// States between ticks.
    pub(crate) states: usize,
    /// Questions within ticks.
    pub(crate) questions: usize,
    pub(crate) edges: usize,
    /// States after merging what no ticks can tell apart; none where a limit was met.
    pub(crate) minimal: Option<usize>,
    /// The ends of a run, and the fewest ticks.
    pub(crate) ends: std::collections::BTreeMap<String, u32>,
    /// States from which no end can be reached.
    pub(crate) stuck: usize,
    pub(crate) complete: bool,
    pub(crate) seconds: f64,
}

/// The answer of `cotama simulate` about a behaviour tree.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TreeSimulateAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/simulate-tree/1")))]
    pub(crate) schema: &'static str,
    pub(crate) model: String,
    /// Ticks played.
    pub(crate) ticks: Vec<TreeTickRow>,
    /// The question that waits for an answer.
    pub(crate) asked: Option<String>,
}
