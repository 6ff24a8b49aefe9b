//! The answers of the commands that check.

pub(crate) mod tree;

use crate::args::Semantics;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;
use std::borrow::Cow;

/// The answer of `cotama check`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CheckAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/check/1")))]
    pub(crate) schema: &'static str,
    pub(crate) model: String,
    /// Whether transitions fire within their intervals; otherwise in any order, at any time.
    pub(crate) timed: bool,
    /// The unit of `min` and `max` and of the times of runs: `ms`; null where there is no time, and
    /// of a file of TINA, which names none.
    pub(crate) time_unit: Option<&'static str>,
    /// Meaning of a system of nets; null of one net.
    pub(crate) semantics: Option<Semantics>,
    /// Notes on the model as it was checked.
    pub(crate) notes: Vec<String>,
    /// Laws of the model that are checked only while a program is compiled.
    pub(crate) left_out: Vec<String>,
    /// Only there if the check was interrupted: then results are of its first properties alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) interrupted: Option<Interrupted>,
    /// An answer to each property, in their order.
    pub(crate) results: Vec<ResultRow>,
}

/// A check that was interrupted.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Interrupted {
    /// How many properties were asked in all.
    pub(crate) asked: usize,
}

/// The answer to a property.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ResultRow {
    pub(crate) name: String,
    /// The number of a requirement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) id: Option<Cow<'static, str>>,
    /// The requirement in a sentence.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sentence: Option<Cow<'static, str>>,
    /// The question, written out.
    pub(crate) property: String,
    /// `true` also of a bound that is known.
    pub(crate) verdict: VerdictName,
    /// Why it is unknown, in words.
    pub(crate) reason: Option<String>,
    /// Remedy, for people.
    #[serde(skip)]
    pub(crate) way_out: Option<&'static str>,
    /// The most tokens, of `bounds(...)`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) bound: Option<Amount>,
    #[serde(flatten)]
    pub(crate) response: Option<ResponseRow>,
    /// The engine that decided.
    pub(crate) engine: String,
    /// Techniques that led to the answer, in order.
    pub(crate) techniques: Vec<String>,
    /// How many markings, or classes of a time net, were met by the engine that met most.
    pub(crate) states: u64,
    /// Evidence that `cotama verify` could check again.
    pub(crate) evidence: EvidenceName,
    /// The file that holds it.
    pub(crate) certificate: Option<String>,
    pub(crate) seconds: f64,
    /// Reason why the property holds vacuously, in words, if one was found.
    pub(crate) vacuous: Option<String>,
    /// How it came about, in a line.
    pub(crate) cause: Option<String>,
    /// The run that shows the verdict, from the start.
    pub(crate) trace: Option<Vec<FiringRow>>,
    /// How the run goes on.
    pub(crate) rest: Option<RestRow>,
    /// Parts that no run uses, where a property is false because of it.
    pub(crate) unused: Option<UnusedRow>,
}

/// Parts that no run uses.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct UnusedRow {
    /// Transitions that never fire.
    pub(crate) transitions: Vec<NeverRow>,
    /// Places that are never marked.
    pub(crate) places: Vec<NeverRow>,
    /// Whether these are all; otherwise a limit was reached, and there may be more.
    pub(crate) is_complete: bool,
}

/// A transition that never fires, or a place that is never marked.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct NeverRow {
    pub(crate) name: String,
    /// Why, as far as single places and transitions tell; names stand in backticks.
    pub(crate) why: String,
}

/// The time from a firing to a marking, of `bound(t -> p)`; null if the transition never fires.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ResponseRow {
    /// The least.
    pub(crate) min: Option<Amount>,
    /// The most.
    pub(crate) max: Option<Amount>,
}

/// The verdict on a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum VerdictName {
    True,
    False,
    /// A limit was reached before.
    Unknown,
}

/// A number, or that there is none so large.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(untagged)]
pub(crate) enum Amount {
    Finite(u64),
    Infinite(Infinite),
}

/// More than any number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) enum Infinite {
    #[serde(rename = "inf")]
    Inf,
}

/// The kind of evidence for a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum EvidenceName {
    /// The verdict is as good as the engine.
    None,
    /// The marking at the start.
    State,
    /// A run to a marking.
    Trace,
    /// A run that goes on for ever.
    Lasso,
    /// Facts that hold in all reachable markings, and exclude what is looked for.
    Refutation,
    /// How many markings there are: all of them are passed through again.
    Graph,
    /// Firings that add tokens again and again.
    Growth,
    /// Evidence for parts.
    Parts,
}

impl EvidenceName {
    /// As in JSON.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::State => "state",
            Self::Trace => "trace",
            Self::Lasso => "lasso",
            Self::Refutation => "refutation",
            Self::Graph => "graph",
            Self::Growth => "growth",
            Self::Parts => "parts",
        }
    }
}

/// A firing.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct FiringRow {
    pub(crate) transition: String,
    /// The event that it answers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) event: Option<String>,
    /// Outputs emitted.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) outputs: Vec<String>,
    /// When, in `time_unit`, as an exact decimal; of time nets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) time: Option<String>,
    /// The places that hold another number of tokens afterwards.
    pub(crate) changed: Vec<ChangeRow>,
}

/// The tokens of a place before and after a firing.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ChangeRow {
    pub(crate) place: String,
    pub(crate) before: u32,
    pub(crate) after: u32,
}

/// How a run goes on after its trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum RestRow {
    /// In any way.
    Any,
    /// Nothing can fire.
    Deadlock,
    /// The firings from this position on, counted from 0, again and again.
    LoopFrom(u64),
}

/// The answer of `cotama statespace`. Counts are strings, as they can pass 64 bits.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct StatespaceAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/statespace/1")))]
    pub(crate) schema: &'static str,
    pub(crate) model: String,
    /// Whether transitions fire within their intervals; otherwise in any order, at any time.
    pub(crate) timed: bool,
    /// Meaning of a system of nets; null of one net.
    pub(crate) semantics: Option<Semantics>,
    /// Notes on the model as it was explored.
    pub(crate) notes: Vec<String>,
    /// Reachable markings, of a time net state classes. This and what follows is null where it is
    /// not known or has no end.
    pub(crate) states: Option<String>,
    /// Firings between them.
    pub(crate) arcs: Option<String>,
    /// The most tokens of a place.
    pub(crate) max_place: Option<String>,
    /// The most tokens of all places together.
    pub(crate) max_sum: Option<String>,
    /// Markings in which nothing can fire.
    pub(crate) deadlocks: Option<String>,
    /// Whether no place ever holds more than one token.
    pub(crate) safe: Option<bool>,
    /// Whether there is a most number of tokens for every place.
    pub(crate) bounded: Option<bool>,
    /// Transitions that never fire.
    pub(crate) dead_transitions: Option<Vec<String>>,
    /// Places that are never marked.
    pub(crate) dead_places: Option<Vec<String>>,
    /// Reachable markings.
    pub(crate) markings: Option<String>,
    /// State classes, of a time net.
    pub(crate) classes: Option<String>,
    /// Firings between them, of a time net.
    pub(crate) edges: Option<String>,
    /// Figures in rounds, of a system with that meaning.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) rounds: Option<RoundsRow>,
    /// How tokens grow without end.
    pub(crate) growth: Option<GrowthRow>,
    /// Figures of the search.
    pub(crate) explored: ExploredRow,
    /// Why that is not all, in words.
    pub(crate) limit: Option<String>,
    /// `explicit`, or `classes` of a time net.
    pub(crate) engine: &'static str,
    pub(crate) seconds: f64,
    /// Memory at the end for each state, if it was measured.
    pub(crate) bytes_per_state: Option<f64>,
}

/// Rounds of a system.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RoundsRow {
    /// Markings between two rounds.
    pub(crate) states: String,
    /// Pairs of one of them and what can come from outside in the round after it, nothing among it.
    pub(crate) edges: String,
}

/// The figures of a search.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ExploredRow {
    pub(crate) states: String,
    pub(crate) arcs: String,
}

/// How tokens grow without end.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct GrowthRow {
    /// Transitions fired at first.
    pub(crate) first: Vec<String>,
    /// Transitions that can fire again and again after them, and add tokens each time.
    pub(crate) repeated: Vec<String>,
}

/// The answer of `cotama verify`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct VerifyAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/verify/1")))]
    pub(crate) schema: &'static str,
    /// Whether the certificate shows its verdict.
    pub(crate) verified: bool,
    /// The net and its size.
    pub(crate) net: Option<String>,
    /// The behaviour tree and its size, in place of a net.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) tree: Option<String>,
    pub(crate) question: Option<String>,
    /// The verdict that is shown.
    pub(crate) verdict: Option<bool>,
    /// Evidence, in words.
    pub(crate) evidence: Option<String>,
    /// Position of the error in the certificate.
    pub(crate) at: Option<String>,
    /// Cause of the error.
    pub(crate) message: Option<String>,
}
