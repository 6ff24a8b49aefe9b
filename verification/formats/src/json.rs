//! A whole net as JSON, written and read: the format `cotama/net/1`.

mod document;
mod words;

pub use words::{Count, Whole, Wrong, in_words, read_object};

use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Net, NetError};
use cotama_core::text;
use document::Document;
use std::collections::BTreeSet;
use std::fmt;

/// Value of the member `schema`.
pub const SCHEMA: &str = "cotama/net/1";
/// The longest text that is read, in bytes.
pub const MAX_BYTES: usize = 64 << 20;
/// The most arcs of one transition, of one law, or of one guard, that are read.
pub const MAX_ARCS: usize = 1000;

/// The net as JSON, every field of it, with names where the net has ids.
///
/// ```json
/// { "schema": "cotama/net/1", "name": "light", "doc": "",
///   "places": [{ "name": "off", "doc": "", "initial": 1, "bound": 1, "role": "state" }],
///   "events": [{ "name": "press", "doc": "" }], "outputs": [],
///   "transitions": [{ "name": "t", "doc": "", "line": 0, "on": "press",
///     "take": [{ "place": "off", "weight": 1 }], "read": [],
///     "give": [{ "place": "off", "weight": 1 }],
///     "emits": [], "within": { "earliest": 0, "latest": null }, "priority": 0 }],
///   "ignored": [{ "event": "press", "place": "off" }],
///   "laws": [{ "reachable": "off" }, "settles"] }
/// ```
///
/// Ids are positions in the lists. `bound` is `null` for
/// [`Place::UNBOUNDED`](cotama_core::net::Place::UNBOUNDED); a role is `"state"`, `"data"`, `{
/// "complement": PLACE }`, `"shared"` or `"mailbox"`; a law is `{ "invariant": { "sum": ARCS,
/// "equals": NUMBER } }`, `{ "never_both": [PLACE, PLACE] }`, `{ "reachable": PLACE }`, `{
/// "always_can": PLACE }`, `"handles_all"`, `"settles"`, `{ "deadlock_free": { "end": PLACE or null
/// } }` or `"deterministic"`. What is ignored under a guard has a member `"guard": ARCS`, tokens
/// that must be there as well. Times are in milliseconds.
///
/// [`read`] gives back the same net, unless names of places, events or outputs occur twice, the net
/// has a [defect](Net::defect), or the text is beyond the limits: it then refuses the text. An id
/// that the net does not have is written as a number.
pub fn write(net: &Net<'_>) -> String {
    // strings and numbers: no error
    let text = serde_json::to_string_pretty(&Document::of(net)).unwrap_or_default();
    format!("{}\n", text::json(&text))
}

/// The net of a JSON text as [`write()`] makes it.
///
/// Members come in any order; none may be missing but `on`, `bound`, `within`, `latest` and `end`,
/// for which that means `null`, and `guard`, and none may be unknown.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::formats::json;
///
/// let mut net = OwnedNet::new("light", "A lamp.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// net.transition(OwnedTransition::new("burn out").take(off, 1)).unwrap();
/// let text = json::write(&net.view().net());
/// assert_eq!(json::read(&text), Ok(net));
///
/// let error = json::read(&text.replace(r#""place": "off""#, r#""place": "of""#)).unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "transition `burn out` names the place `of`, which the net does not have"
/// );
/// ```
///
/// # Errors
/// [`JsonNetError`], which says what is wrong and where.
pub fn read(text: &str) -> Result<OwnedNet, JsonNetError> {
    if text.len() > MAX_BYTES {
        return Err(JsonNetError::TooLong { bytes: text.len() });
    }
    let document: Document<String> = read_object(text).map_err(|error| {
        let Wrong { line, column, message, help, .. } = error;
        JsonNetError::Json { line, column, what: message, help }
    })?;
    let net = document.net()?;
    match net.view().net().defect() {
        None => Ok(net),
        Some(defect) => Err(JsonNetError::Defect { defect, at: place_of(defect, &net) }),
    }
}

/// Why a text is no net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JsonNetError {
    /// The text is longer than [`MAX_BYTES`].
    TooLong {
        /// Length of the text.
        bytes: usize,
    },
    /// The text is no JSON, or not of this shape.
    Json {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The cause of the error.
        what: String,
        /// The help, where that is more than `what` says.
        help: Option<String>,
    },
    /// `schema` is another one than [`SCHEMA`].
    Schema {
        /// The value found.
        found: String,
    },
    /// Two places, events or outputs of the same name: a reference by name would mean either.
    Twice {
        /// `place`, `event` or `output`.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A reference to what the net does not have.
    Unknown {
        /// Position of the reference.
        at: String,
        /// `place`, `event` or `output`.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A transition, law or guard with more than [`MAX_ARCS`] arcs.
    TooManyArcs {
        /// Position of the values.
        at: String,
    },
    /// The lists do not fit together.
    Defect {
        /// The defect.
        defect: NetError,
        /// The place or transition.
        at: String,
    },
}

impl fmt::Display for JsonNetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong { bytes } => {
                write!(f, "the text has {bytes} bytes, more than the {MAX_BYTES} that are read")
            }
            Self::Json { line, column, what, .. } => {
                write!(f, "line {line}, column {column}: {what}")
            }
            Self::Schema { found } => {
                write!(f, "`schema` is `{found}`, but this reader knows only `{SCHEMA}`")
            }
            Self::Twice { kind, name } => {
                write!(f, "two {kind}s are named `{name}`; give each a name of its own")
            }
            Self::Unknown { at, kind, name } => {
                write!(f, "{at} names the {kind} `{name}`, which the net does not have")
            }
            Self::TooManyArcs { at } => write!(f, "{at} has more than {MAX_ARCS} arcs"),
            Self::Defect { defect, at } => write!(f, "{at} {}", fault(*defect)),
        }
    }
}

impl std::error::Error for JsonNetError {}

fn fault(defect: NetError) -> &'static str {
    match defect {
        NetError::TooLong => "has more entries than ids can count",
        NetError::UnknownId { .. } => "names something that the net does not have",
        NetError::Arcs { .. } => {
            "has an arc of weight 0, or names a place twice in `give`, or in `take` and `read` \
             together"
        }
        NetError::Interval { .. } => {
            "has an interval that ends before it begins, or after 4294967294 ms"
        }
        NetError::Place { .. } => {
            "has more tokens at the start than its bound, or does not sum to the bound with the \
             place that it complements"
        }
        NetError::Law => "has an arc of weight 0, or a place twice in one sum or guard",
        NetError::Twice { .. } => "has the name of an earlier one",
        _ => "does not fit together",
    }
}

/// Returns the subject of a defect.
fn place_of(defect: NetError, net: &OwnedNet) -> String {
    match defect {
        NetError::TooLong => "a list".to_owned(),
        NetError::Place { place } => match net.places.get(place) {
            Some(place) => format!("place `{}`", place.name),
            None => format!("place {place}"),
        },
        NetError::UnknownId { transition }
        | NetError::Arcs { transition }
        | NetError::Interval { transition } => match net.transitions.get(transition) {
            Some(transition) => format!("transition `{}`", transition.name),
            None => format!("transition {transition}"),
        },
        NetError::Law => "a law, or an entry of `ignored`,".to_owned(),
        NetError::Twice { list, at } => format!("entry {at} of the {list}"),
        _ => "the net".to_owned(),
    }
}

/// The first name that occurs twice.
fn twice<'a>(names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let mut seen = BTreeSet::new();
    names.into_iter().find(|name| !seen.insert(*name))
}
