//! The answers of the commands about models.

#[cfg(test)]
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
#[cfg(test)]
use std::collections::BTreeMap;

/// The answer of `cotama models`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ModelsAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/models/1")))]
    pub(crate) schema: &'static str,
    pub(crate) models: Vec<ModelRow>,
}

/// A model.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ModelRow {
    /// Name for other commands; of a family without its number.
    pub(crate) name: String,
    pub(crate) kind: ModelKind,
    /// Purpose of the model.
    pub(crate) description: String,
    /// Number of places; none of a family, before a number is chosen. In a system, shared places
    /// are counted once.
    pub(crate) places: Option<u64>,
    /// Number of transitions; none of a family.
    pub(crate) transitions: Option<u64>,
    /// Transitions with a time interval; none of a family.
    pub(crate) timed: Option<u64>,
    /// Reachable markings, if they were explored while compiling.
    pub(crate) states: Option<u64>,
    /// The firings between these markings.
    pub(crate) firings: Option<u64>,
    /// The most transitions that fire at once by themselves one after another, if it is proven.
    pub(crate) settle: Option<u32>,
    pub(crate) laws: Vec<LawRow>,
    pub(crate) events: Vec<SignalRow>,
    pub(crate) outputs: Vec<SignalRow>,
    /// The numbers of a family.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) numbers: Option<NumbersRow>,
    /// The nets of a system, in the order of their turns.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) components: Vec<ComponentRow>,
}

/// The kind of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum ModelKind {
    /// One net.
    Net,
    /// A net for each number.
    Family,
    /// Several nets that work together.
    System,
}

/// A law claimed of a net.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct LawRow {
    /// As `never_both(Closing, obstacle)`.
    pub(crate) law: String,
    pub(crate) shown: Shown,
}

/// How a law is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum Shown {
    /// In all reachable markings, while this program was compiled.
    WhileCompiling,
    /// Not yet: the net is too large to explore while compiling.
    LeftToChecker,
    /// Not: it is only said.
    Claimed,
}

/// An event or an output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct SignalRow {
    pub(crate) name: String,
    /// Meaning of the signal.
    pub(crate) doc: String,
}

/// The numbers of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct NumbersRow {
    pub(crate) least: u32,
    pub(crate) most: u32,
}

/// A net of a system.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ComponentRow {
    /// Name of the net in the system.
    pub(crate) name: String,
    /// The name of the net.
    pub(crate) net: String,
}

/// The answer of `cotama simulate`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct SimulateAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/simulate/1")))]
    pub(crate) schema: &'static str,
    /// The name of the net or system.
    pub(crate) model: String,
    /// Whether each word was a round: of a net a synchronous step; of a system the turns of its
    /// nets, then what is offered.
    pub(crate) rounds: bool,
    /// Whether transitions are fired by name, as the net has neither events nor time.
    pub(crate) by_name: bool,
    /// Whether all events were offered; not if the net did not come to rest.
    pub(crate) complete: bool,
    /// How many events no transition used.
    pub(crate) ignored: u64,
    /// The time at the end.
    pub(crate) time_ms: u64,
    /// The transitions that fired, in this order.
    pub(crate) fired: Vec<String>,
    pub(crate) steps: Vec<StepRow>,
    /// The tokens of each place at the end, in the order of the net.
    #[serde(serialize_with = "as_object")]
    #[cfg_attr(test, schemars(with = "BTreeMap<String, u32>"))]
    pub(crate) marking: Vec<(String, u32)>,
    /// The events that a transition would use at the end.
    pub(crate) enabled: Vec<EnabledRow>,
    /// The events that no transition would use at the end.
    pub(crate) unused: Vec<RefusalRow>,
    /// Next event by itself.
    pub(crate) deadline: Option<DeadlineRow>,
}

/// The answer of `cotama play`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PlayAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/play/1")))]
    pub(crate) schema: &'static str,
    /// The page.
    pub(crate) file: String,
    /// Its size.
    pub(crate) bytes: u64,
}

/// Something that happened: an event with what settled after it, what fired by itself, or a round.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct StepRow {
    pub(crate) time_ms: u64,
    /// The events that were offered; none for what fired by itself.
    pub(crate) events: Vec<String>,
    /// Whether it is what the nets of a system did in their turns, with what they had mailed.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) round: bool,
    /// The transitions that fired, in this order.
    pub(crate) fired: Vec<String>,
    /// The events that no transition used.
    pub(crate) ignored: Vec<RefusalRow>,
    /// The outputs that were emitted, in this order.
    pub(crate) emitted: Vec<String>,
    /// The places that hold another number of tokens afterwards.
    pub(crate) changed: Vec<TokensRow>,
}

/// An event that no transition uses.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RefusalRow {
    pub(crate) event: String,
    pub(crate) reason: RefusalReason,
    /// The same in words.
    pub(crate) text: String,
}

/// Why no transition uses an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum RefusalReason {
    /// A marked place ignores it on purpose.
    OnPurpose,
    /// No transition on it has the tokens that it needs.
    NotEnabled,
    /// One has, but its interval has not begun.
    TooEarly,
    /// One has, but its interval is over.
    TooLate,
    /// One has, but a place would hold more than its bound, or a mailbox is full.
    Full,
}

/// The tokens of a place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TokensRow {
    pub(crate) place: String,
    pub(crate) tokens: u32,
}

/// An event that a transition would use.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct EnabledRow {
    pub(crate) event: String,
    pub(crate) transition: String,
}

/// The next event by itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DeadlineRow {
    pub(crate) time_ms: u64,
    pub(crate) transition: String,
}

fn as_object<S: Serializer>(marking: &[(String, u32)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(marking.iter().map(|(place, tokens)| (place, tokens)))
}
