//! The queue of events for the supervisors, in its order.

/// More than there are kinds of failures and returns, so that there is room once each waits once.
const ROOM: usize = 16;

/// News of a kind `K`, each with its cause `C`: a ring, so that nothing is moved when one is told.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pending<K, C> {
    waiting: [Option<(K, C)>; ROOM],
    /// The oldest.
    first: usize,
    length: usize,
}

impl<K, C> Default for Pending<K, C> {
    fn default() -> Self {
        Self { waiting: [const { None }; ROOM], first: 0, length: 0 }
    }
}

impl<K: Copy + PartialEq, C: Copy> Pending<K, C> {
    pub(super) const fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Nothing waits any more.
    pub(super) fn clear(&mut self) {
        self.waiting.fill(None);
        (self.first, self.length) = (0, 0);
    }

    /// Something more waits. When there is no room, what waits twice waits once.
    pub(super) fn push(&mut self, told: K, cause: C) {
        if self.length == ROOM {
            self.keep_one_of_each();
        }
        let end = self.first.wrapping_add(self.length) % ROOM;
        if let (Some(slot), true) = (self.waiting.get_mut(end), self.length < ROOM) {
            *slot = Some((told, cause));
            self.length = self.length.saturating_add(1);
        }
    }

    pub(super) fn pop(&mut self) -> Option<(K, C)> {
        self.length = self.length.checked_sub(1)?;
        let oldest = self.waiting.get_mut(self.first)?.take();
        self.first = self.first.wrapping_add(1) % ROOM;
        oldest
    }

    /// Iterates over the queue, the oldest first.
    fn iter(&self) -> impl Iterator<Item = (K, C)> {
        let later = self.waiting.iter().skip(self.first);
        later.chain(self.waiting.iter().take(self.first)).take(self.length).flatten().copied()
    }

    fn keep_one_of_each(&mut self) {
        let before = *self;
        self.clear();
        for (told, cause) in before.iter() {
            if !self.iter().any(|it| it.0 == told) {
                self.push(told, cause);
            }
        }
    }
}
