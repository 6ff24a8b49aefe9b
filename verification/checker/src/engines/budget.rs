//! The budget of an engine.

use crate::explicit::{Limit, Limits, Progress};
use std::time::{Duration, Instant};

/// The budget of an engine.
#[derive(Clone, Copy)]
pub struct Budget<'b> {
    /// Markings, bytes, time.
    pub limits: Limits,
    /// Threads.
    pub jobs: usize,
    /// Whether evidence is worth more work.
    pub evidence: bool,
    /// Called now and then.
    pub progress: &'b dyn Fn(Progress),
}

impl Budget<'_> {
    /// Half of the memory and of the time that is left.
    pub fn half(&self) -> Limits {
        let now = Instant::now();
        let left =
            |it: Instant| now + it.saturating_duration_since(now) / 2 + Duration::from_millis(1);
        let limits = self.limits;
        Limits { bytes: limits.bytes / 2, deadline: limits.deadline.map(left), ..limits }
    }

    /// The same with these limits.
    #[must_use]
    pub fn with(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// Whether it allows to go further than a search that reached one of these limits.
    pub(crate) fn has_more(&self, limits: &Limits, reached: Limit) -> bool {
        match reached {
            Limit::States => self.limits.states > limits.states,
            Limit::Bytes => self.limits.bytes > limits.bytes,
            Limit::Time => limits
                .deadline
                .is_some_and(|it| self.limits.deadline.is_none_or(|later| it < later)),
            Limit::Tokens | Limit::Words | Limit::Unbounded | Limit::Work => false,
        }
    }

    /// The same for coverability.
    pub(crate) fn coverability(&self) -> Limits {
        Limits { states: self.limits.states.min(10_000_000), ..self.limits }
    }
}
