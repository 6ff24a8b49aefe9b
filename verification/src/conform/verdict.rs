//! The verdict on a recording.

use super::departure::Departure;
use cotama_core::units::Millis;

/// The verdict on a recording.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Verdict {
    /// How many events were told.
    pub events: u64,
    /// How many recorded firings are those of the model.
    pub fired: u64,
    /// How many recorded outputs are those of the model.
    pub outputs: u64,
    /// How many rounds took place.
    pub rounds: u64,
    /// The date of the last line that is as the model.
    pub until: Millis,
    /// The departure from the model; `None` when the recording is a run of it.
    pub departs: Option<Departure>,
    /// The line before which too many states were possible to say whether it is a run; then
    /// [`departs`](Self::departs) is none.
    pub unknown: Option<usize>,
}
