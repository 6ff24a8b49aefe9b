//! What an engine may use.

use super::Options;
use crate::coverability;
use crate::explicit::{Limit, Limits, Progress};

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
    /// Whether it allows to go further than a search that reached one of these limits.
    pub(super) fn has_more(&self, limits: &Limits, reached: Limit) -> bool {
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
    pub(super) fn coverability<'s>(&self, stop: &'s dyn Fn() -> bool) -> coverability::Limits<'s> {
        let nodes = self.limits.states.min(10_000_000);
        coverability::Limits {
            nodes,
            bytes: self.limits.bytes,
            stop,
            ..coverability::Limits::default()
        }
    }
}

impl<'b> From<&Options<'b>> for Budget<'b> {
    fn from(options: &Options<'b>) -> Self {
        let Options { limits, jobs, evidence, progress, .. } = *options;
        Self { limits, jobs, evidence, progress }
    }
}
