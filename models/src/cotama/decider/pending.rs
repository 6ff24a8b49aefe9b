//! What the supervisors are still to be told, in its order.

/// More than there are kinds of failures and returns, so that there is room once each waits once.
const ROOM: usize = 16;

/// News of a kind `K`, each with its cause `C`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pending<K, C> {
    waiting: [Option<(K, C)>; ROOM],
    length: usize,
}

impl<K, C> Default for Pending<K, C> {
    fn default() -> Self {
        Self { waiting: [const { None }; ROOM], length: 0 }
    }
}

impl<K: Copy + PartialEq, C: Copy> Pending<K, C> {
    pub(super) const fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Something more waits. When there is no room, what waits twice waits once.
    pub(super) fn push(&mut self, told: K, cause: C) {
        if self.length == ROOM {
            self.keep_one_of_each();
        }
        if let Some(slot) = self.waiting.get_mut(self.length) {
            *slot = Some((told, cause));
            self.length = self.length.saturating_add(1);
        }
    }

    pub(super) fn pop(&mut self) -> Option<(K, C)> {
        let first = self.waiting.iter().take(self.length).next().copied()?;
        self.waiting.rotate_left(1);
        self.length = self.length.saturating_sub(1);
        first
    }

    fn keep_one_of_each(&mut self) {
        let before = *self;
        self.length = 0;
        for &(told, cause) in before.waiting.iter().take(before.length).flatten() {
            if !self.waiting.iter().take(self.length).flatten().any(|it| it.0 == told) {
                self.push(told, cause);
            }
        }
    }
}
