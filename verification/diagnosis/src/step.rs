//! The steps of a run: its firings, the changes of each, and the values followed along it.

use cotama_property::schedule::Date;
use serde::{Serialize, Serializer};

/// A marked place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Tokens {
    /// The place.
    pub place: String,
    /// Number of tokens.
    pub tokens: u32,
}

/// A firing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Step {
    /// The transition.
    pub transition: String,
    /// The event that it needs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub event: Option<String>,
    /// The outputs emitted.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outputs: Vec<String>,
    /// When it fires.
    #[serde(
        rename = "at_ms",
        serialize_with = "milliseconds",
        skip_serializing_if = "Option::is_none"
    )]
    pub at: Option<Date>,
    /// The changes of places.
    pub changes: Vec<Change>,
    /// Which atoms of the property it makes true or false.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub turns: Vec<Turn>,
}

/// How a firing changes a place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Change {
    /// The place.
    pub place: String,
    /// Tokens before.
    pub before: u32,
    /// Tokens after.
    pub after: u32,
}

/// An atom of the property that becomes true or false.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Turn {
    /// The atom.
    pub atom: String,
    /// Whether it holds after the firing.
    pub holds: bool,
}

/// The tokens of a place, from the initial marking to the one after the last firing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Track {
    /// The place.
    pub place: String,
    /// Tokens at each marking.
    pub tokens: Vec<u32>,
}

/// An atom of the property, from the initial marking to the one after the last firing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct AtomTrack {
    /// The atom.
    pub atom: String,
    /// Whether it holds.
    pub holds: Vec<bool>,
    /// Whether it only says that a place is marked.
    #[serde(skip)]
    pub(super) is_mark: bool,
}

/// The meaning of a place or a transition.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Meaning {
    /// Name of the place or transition.
    pub name: String,
    /// Documentation.
    pub doc: String,
}

#[allow(clippy::ref_option, reason = "serde asks for it")]
fn milliseconds<S: Serializer>(at: &Option<Date>, serializer: S) -> Result<S::Ok, S::Error> {
    match at {
        Some(Date { parts, per_unit: 1 }) => serializer.serialize_u64(*parts),
        // A double holds eighths of a millisecond for longer than any run takes.
        #[allow(clippy::cast_precision_loss, reason = "it is for display")]
        Some(date) => serializer.serialize_f64(date.parts as f64 / date.per_unit as f64),
        None => serializer.serialize_none(),
    }
}
