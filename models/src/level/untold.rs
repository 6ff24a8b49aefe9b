//! News that wait to be told.

use super::tables::{MAX_LOSSES, MAX_REPORTS};
use super::told::{Cause, Told};

/// Each report and each return waits once.
const ROOM: usize = MAX_REPORTS + MAX_LOSSES;

/// Reports and returns in the order in which they came, each once, with its cause.
#[derive(Clone, Copy, Debug)]
pub(super) struct Untold {
    waiting: [(u8, Cause); ROOM],
    length: usize,
}

impl Default for Untold {
    fn default() -> Self {
        Self { waiting: [(0, Cause(0)); ROOM], length: 0 }
    }
}

impl Untold {
    pub(super) const fn is_empty(&self) -> bool {
        self.length == 0
    }

    pub(super) fn has(&self, told: Told) -> bool {
        let Some(number) = number(told) else { return false };
        self.waiting.iter().take(self.length).any(|it| it.0 == number)
    }

    /// Lets a report or a return wait, if it does not already.
    pub(super) fn push(&mut self, told: Told, cause: Cause) {
        let Some(number) = number(told).filter(|_| !self.has(told)) else { return };
        let length = self.length;
        if let Some(slot) = self.waiting.get_mut(length) {
            *slot = (number, cause);
            self.length = length + 1;
        }
    }

    /// Takes the oldest.
    pub(super) fn pop(&mut self) -> Option<(Told, Cause)> {
        let (number, cause) = *self.waiting.get(..self.length)?.first()?;
        self.waiting.copy_within(1.., 0);
        self.length -= 1;
        let number = usize::from(number);
        Some(match number.checked_sub(MAX_REPORTS) {
            Some(loss) => (Told::Back(loss), cause),
            None => (Told::Report(number), cause),
        })
    }
}

/// Returns the number of a report or a return.
fn number(told: Told) -> Option<u8> {
    match told {
        Told::Report(it) if it < MAX_REPORTS => Some(it as u8),
        Told::Back(it) if it < MAX_LOSSES => Some((MAX_REPORTS + it) as u8),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Cause, ROOM, Told, Untold};

    #[test]
    fn news_wait_once_each_in_their_order() {
        let mut untold = Untold::default();
        let all = (0..64).map(Told::Report).chain((0..10).map(Told::Back));
        let all: Vec<_> = all.collect();
        assert_eq!(all.len(), ROOM);
        for (number, it) in all.iter().chain(&all).enumerate() {
            untold.push(*it, Cause(number as u16));
        }
        let told: Vec<_> = core::iter::from_fn(|| untold.pop()).collect();
        assert_eq!(told, all.into_iter().zip((0..).map(Cause)).collect::<Vec<_>>());
        assert!(untold.is_empty());
    }
}
