//! The cost of a question so far.

use super::{Effort, Limit, Limits};
use std::time::Instant;

/// Between two looks at the clock: some milliseconds.
const TICK: u64 = 1 << 17;

/// The budget left for a question.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    pub(super) left: u64,
    /// Work done since the clock was looked at.
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
    pub(super) fn spend(&mut self, numbers: usize) -> Result<(), Limit> {
        self.left = self.left.checked_sub(numbers as u64).ok_or(Limit::Work)?;
        self.look(numbers as u64)
    }

    /// Counts what is only copied or passed over: a sixteenth.
    pub(super) fn pass(&mut self, items: usize) -> Result<(), Limit> {
        self.left = self.left.checked_sub(items as u64 / 16).ok_or(Limit::Work)?;
        self.look(items as u64)
    }

    fn look(&mut self, done: u64) -> Result<(), Limit> {
        self.done += done;
        if self.done < TICK {
            return Ok(());
        }
        self.done = 0;
        if self.deadline.is_some_and(|it| Instant::now() >= it) { Err(Limit::Time) } else { Ok(()) }
    }
}

/// The budget of a question.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    pub(super) work: u64,
    /// Cases that are told apart.
    pub(super) nodes: u32,
    pub(super) deadline: Option<Instant>,
}

impl Cost {
    /// This effort within limits. Each number of a row takes 16 bytes, and of what is looked at at
    /// most a quarter is kept.
    pub(super) fn new(effort: Effort, limits: &Limits) -> Self {
        let work = effort.work.min(limits.bytes / 64);
        Self { work, nodes: effort.nodes, deadline: limits.deadline }
    }
}

impl From<Cost> for Work {
    fn from(cost: Cost) -> Self {
        Self::new(cost.work, cost.deadline)
    }
}
