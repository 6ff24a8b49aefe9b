//! The answer of `cotama conform`.

use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama conform`.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct ConformAnswer {
    #[schemars(extend("const" = "cotama/conform/1"))]
    pub(crate) schema: &'static str,
    /// What the command line calls the net or system.
    pub(crate) model: String,
    /// The file of the recorded run.
    pub(crate) trace: String,
    /// Whether the recorded run is a run of the model.
    pub(crate) conforms: bool,
    /// How many lines say something.
    pub(crate) lines: u64,
    /// How many events were told again.
    pub(crate) events: u64,
    /// How many recorded firings are those of the model.
    pub(crate) fired: u64,
    /// How many rounds of a system took place.
    pub(crate) rounds: u64,
    /// The date up to which the recording is as the model.
    pub(crate) until_ms: u64,
    /// Where it departs from the model; none when it conforms.
    pub(crate) departs: Option<DepartsRow>,
}

/// Where a recording departs from a model.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct DepartsRow {
    /// The line of the file, from 1.
    pub(crate) line: u64,
    pub(crate) time_ms: u64,
    /// Why it cannot be so.
    pub(crate) reason: String,
    /// What could have been recorded there.
    pub(crate) allowed: AllowedRow,
}

/// What could have been recorded.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct AllowedRow {
    /// The transitions that could fire, or had to.
    pub(crate) fired: Vec<MayFireRow>,
    /// The events that a transition would have used.
    pub(crate) events: Vec<MayTellRow>,
}

/// A transition that could fire.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct MayFireRow {
    pub(crate) transition: String,
    pub(crate) earliest_ms: u64,
    /// None: at any time after that.
    pub(crate) latest_ms: Option<u64>,
}

/// An event that would have been used.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct MayTellRow {
    pub(crate) event: String,
    /// The transition that it would have made fire.
    pub(crate) transition: String,
}
