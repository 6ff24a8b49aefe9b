//! What the supervisors are still to be told, in its order.

use crate::cotama::level::{Cause, Told};
use crate::cotama::supervisors::faults;

/// More than there are kinds of failures and returns, so that there is room once each waits once.
const ROOM: usize = 16;

const NOTHING: (Told, Cause) = (Told::Failure(faults::Event::drift), Cause(0));

#[derive(Clone, Copy, Debug)]
pub(super) struct Pending {
    waiting: [(Told, Cause); ROOM],
    length: usize,
}

impl Default for Pending {
    fn default() -> Self {
        Self { waiting: [NOTHING; ROOM], length: 0 }
    }
}

impl Pending {
    pub(super) const fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Something more waits. When there is no room, what waits twice waits once.
    pub(super) fn push(&mut self, told: Told, cause: Cause) {
        if self.length == ROOM {
            self.keep_one_of_each();
        }
        if let Some(slot) = self.waiting.get_mut(self.length) {
            *slot = (told, cause);
            self.length = self.length.saturating_add(1);
        }
    }

    pub(super) fn pop(&mut self) -> Option<(Told, Cause)> {
        let first = self.waiting.iter().take(self.length).next().copied()?;
        self.waiting.rotate_left(1);
        self.length = self.length.saturating_sub(1);
        Some(first)
    }

    fn keep_one_of_each(&mut self) {
        let before = *self;
        self.length = 0;
        for &(told, cause) in before.waiting.iter().take(before.length) {
            if !self.waiting.iter().take(self.length).any(|it| it.0 == told) {
                self.push(told, cause);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cotama::supervisors::faults::Event;

    #[test]
    fn a_flood_loses_no_kind_of_failure() {
        let mut pending = Pending::default();
        (0..1_000).for_each(|it| pending.push(Told::Failure(Event::drift), Cause(it)));
        pending.push(Told::Failure(Event::lose_vital), Cause(1_000));
        let mut told = Vec::new();
        while let Some((it, _)) = pending.pop() {
            told.push(it);
        }
        assert!(told.len() <= ROOM && told.contains(&Told::Failure(Event::drift)));
        assert_eq!(told.last(), Some(&Told::Failure(Event::lose_vital)));
    }
}
