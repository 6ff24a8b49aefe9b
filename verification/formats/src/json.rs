//! Nets and systems of nets as JSON, written and read: the formats `cotama/net/1` and
//! `cotama-system/1`.

mod document;
mod known;
mod name;
mod system;
mod words;

pub use system::{SYSTEM_SCHEMA, read_system, write_system};
pub use words::{Count, Whole, Wrong, in_words, read_object};

use cotama_core::net::Net;
use cotama_core::net::owned::OwnedNet;
use cotama_core::text;
use document::Document;
use name::Name;

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
/// assert_eq!((error.line, error.column), (24, 20));
/// let message = "transition `burn out` names the place `of`, which the net does not have";
/// assert_eq!(error.message, message);
/// ```
///
/// # Errors
/// The first thing that is wrong, and its place in the text.
pub fn read(text: &str) -> Result<OwnedNet, Wrong> {
    let document: Document<Name> = read_document(text)?;
    document.net().map(|it| it.0).map_err(|it| it.placed(text))
}

/// A text of at most [`MAX_BYTES`] as what one of the formats says.
fn read_document<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, Wrong> {
    if text.len() > MAX_BYTES {
        let message =
            format!("the text has {} bytes, more than the {MAX_BYTES} that are read", text.len());
        return Err(Wrong { line: 1, column: 1, message, help: None, cut_off: false });
    }
    read_object(text)
}
