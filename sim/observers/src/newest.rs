//! Signals that were looked at before.

use cotama_core::units::Millis;

/// The time when the newest signal was taken.
///
/// An observer is asked in each period, but a signal may come less often, or stop: one that was
/// looked at before is no new evidence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Newest(Option<Millis>);

impl Newest {
    /// Whether a signal is newer than all before; then it is the newest.
    pub(crate) fn is_new(&mut self, taken: Millis) -> bool {
        let is_new = self.0.is_none_or(|it| taken > it);
        if is_new {
            self.0 = Some(taken);
        }
        is_new
    }
}
