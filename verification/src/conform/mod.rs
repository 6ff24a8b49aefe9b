//! Whether a recorded run is a run of a model, and where it departs.
//!
//! # A recording
//!
//! JSON lines, `cotama-recording/1`. Each line says when, in whole milliseconds that never go back,
//! and one thing:
//!
//! ```json
//! {"schema":"cotama-recording/1","start_ms":0}
//! {"t_ms":0,"event":"Call"}
//! {"t_ms":0,"fired":"call"}
//! {"t_ms":2000,"event":"EndOpen"}
//! {"t_ms":2000,"fired":"opened"}
//! {"t_ms":7000,"fired":"close"}
//! {"t_ms":7500,"end":true}
//! ```
//!
//! | line | what it says |
//! | --- | --- |
//! | `event` | the model was told it, `NET.EVENT` in a system; `"ignored"`: whether in vain |
//! | `fired` | the transition fired, `NET.TRANSITION` in a system |
//! | `round` | a round of a system took place: each net read its mailboxes |
//! | `end` | until then nothing else happened; else the recording ends with its last line |
//!
//! The first line may be a header: when the model started (`start_ms`, 0), how often a round takes
//! place (`round_every_ms`; the first one at the start, each before anything else of its instant),
//! and the nets whose firings are not recorded (`silent`). A system without that period and without
//! `round` lines takes a round at once whenever something waits in a mailbox. Further members and
//! empty lines are not read. [`LINE_SCHEMA`] is the JSON schema of a line.
//!
//! # What a run is
//!
//! What was recorded is told to a player of the model again, at the same dates. The recording is a
//! run when every transition that fires is recorded when it fires, in that order, and none besides.
//! What the model leaves open is taken from the recording: a transition without event that has an
//! interval fires when the recording says so, within its interval, and no time passes its end; in
//! what is due at one instant, the order of the recording counts. So the runs are those that the
//! checker knows. In a net without events and time every transition fires as it is recorded.
//!
//! Dates of a real robot are not exact: a [`tolerance`](Options::tolerance) widens every interval
//! of a transition without event on both sides, and lets what fires at once be recorded so much
//! later.

mod allowed;
mod checked;
mod departure;
mod hidden;
mod names;
mod pending;
mod read;
mod rules;
mod verdict;
mod way;

pub use allowed::{Allowed, MayFire, MayTell};
pub use checked::{MOST_STATES, Options, conform};
pub use departure::{Departure, Refused};
pub use read::{Line, MAX_LINES, MAX_MS, Recording, RecordingError, SCHEMA, What};
pub use verdict::Verdict;

/// The JSON schema of a line of a recording.
///
/// ```json
#[doc = include_str!("line.schema.json")]
/// ```
pub const LINE_SCHEMA: &str = include_str!("line.schema.json");
