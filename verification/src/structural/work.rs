//! What a question has cost so far.

use super::{Limits, Stop};
use std::time::Instant;

/// Between two looks at the clock: some milliseconds.
const TICK: u64 = 1 << 17;

/// What a question may still cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    pub(super) left: u64,
    /// What was done since the clock was looked at.
    done: u64,
    deadline: Option<Instant>,
}

impl Work {
    pub(super) const fn new(left: u64, deadline: Option<Instant>) -> Self {
        // The first time the clock is looked at in any case.
        Self { left, done: TICK, deadline }
    }

    pub(super) const fn unlimited() -> Self {
        Self::new(u64::MAX, None)
    }

    /// The same within other limits.
    pub(super) const fn with(self, left: u64) -> Self {
        Self { left, ..self }
    }

    /// Counts numbers that are computed.
    pub(super) fn spend(&mut self, numbers: usize) -> Result<(), Stop> {
        self.left = self.left.checked_sub(numbers as u64).ok_or(Stop::Work)?;
        self.look(numbers as u64)
    }

    /// Counts what is only copied or passed over: a sixteenth.
    pub(super) fn pass(&mut self, items: usize) -> Result<(), Stop> {
        self.left = self.left.checked_sub(items as u64 / 16).ok_or(Stop::Work)?;
        self.look(items as u64)
    }

    fn look(&mut self, done: u64) -> Result<(), Stop> {
        self.done += done;
        if self.done < TICK {
            return Ok(());
        }
        self.done = 0;
        if self.deadline.is_some_and(|it| Instant::now() >= it) { Err(Stop::Time) } else { Ok(()) }
    }
}

impl From<Limits> for Work {
    fn from(limits: Limits) -> Self {
        Self::new(limits.work, limits.deadline)
    }
}
