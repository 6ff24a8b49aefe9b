//! What an engine may use.

use crate::coverability;
use crate::explicit::{Limit, Limits, Progress};
use crate::tpn;
use std::time::{Duration, Instant};

/// What an engine may use.
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
            Limit::Tokens | Limit::Words | Limit::Unbounded => false,
        }
    }

    /// The same for coverability.
    pub(crate) fn coverability<'s>(&self, stop: &'s dyn Fn() -> bool) -> coverability::Limits<'s> {
        let nodes = self.limits.states.min(10_000_000);
        coverability::Limits {
            nodes,
            bytes: self.limits.bytes,
            stop,
            ..coverability::Limits::default()
        }
    }

    /// The same for state classes.
    pub(crate) fn classes<'s>(&self, stop: &'s dyn Fn() -> bool) -> tpn::Limits<'s> {
        let number = |it: u64| usize::try_from(it).unwrap_or(usize::MAX);
        tpn::Limits { classes: number(self.limits.states), bytes: number(self.limits.bytes), stop }
    }
}
