//! The answer of `cotama conform`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama conform`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ConformAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/conform/1")))]
    pub(crate) schema: &'static str,
    /// Name of the net or system on the command line.
    pub(crate) model: String,
    /// The file of the recorded run.
    pub(crate) trace: String,
    /// Whether the recorded run is a run of the model; none when too many states were possible to
    /// say so.
    pub(crate) conforms: Option<bool>,
    /// How many lines say something.
    pub(crate) lines: u64,
    /// How many events were told again.
    pub(crate) events: u64,
    /// How many recorded firings are those of the model.
    pub(crate) fired: u64,
    /// How many recorded outputs are those of the model.
    pub(crate) outputs: u64,
    /// How many rounds of a system took place.
    pub(crate) rounds: u64,
    /// The date up to which the recording is as the model.
    pub(crate) until_ms: u64,
    /// Departure from the model; none when the recording conforms.
    pub(crate) departs: Option<DepartsRow>,
    /// The line at which too many states were possible; none when it was not so.
    pub(crate) unknown_from: Option<u64>,
}

/// The departure of a recording from a model.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DepartsRow {
    /// The line of the file, from 1.
    pub(crate) line: u64,
    pub(crate) time_ms: u64,
    /// Why it cannot be so.
    pub(crate) reason: String,
    /// Records allowed there.
    pub(crate) allowed: AllowedRow,
}

/// The records allowed.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AllowedRow {
    /// The transitions that could fire, or had to.
    pub(crate) fired: Vec<MayFireRow>,
    /// The events that a transition would have used.
    pub(crate) events: Vec<MayTellRow>,
}

/// A transition that could fire.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MayFireRow {
    pub(crate) transition: String,
    pub(crate) earliest_ms: u64,
    /// Latest time in ms; none: at any time after that.
    pub(crate) latest_ms: Option<u64>,
}

/// An event that would have been used.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MayTellRow {
    pub(crate) event: String,
    /// The transition that it would have made fire.
    pub(crate) transition: String,
}
