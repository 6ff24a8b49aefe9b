//! What a search may use, from the command line.

use crate::args::BudgetArgs;
use cotama_verification::{coverability, explicit, tpn};
use std::time::Instant;

/// What a search may use, from now on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    pub(crate) jobs: usize,
    pub(crate) limits: explicit::Limits,
}

impl Budget {
    /// The time begins to run.
    pub(crate) fn start(args: BudgetArgs) -> Self {
        let limits = explicit::Limits {
            states: args.max_states.unwrap_or(u64::MAX),
            bytes: args.max_memory.saturating_mul(1 << 20),
            deadline: args.max_seconds.and_then(|it| Instant::now().checked_add(it)),
        };
        Self { jobs: usize::try_from(args.jobs).unwrap_or(1), limits }
    }

    /// The same with an even part of the time that is left, for the next of so many.
    pub(crate) fn share(self, of: usize) -> Self {
        let part = |deadline: Instant| {
            let now = Instant::now();
            let left = deadline.saturating_duration_since(now);
            now + left / u32::try_from(of.max(1)).unwrap_or(u32::MAX)
        };
        Self {
            limits: explicit::Limits { deadline: self.limits.deadline.map(part), ..self.limits },
            ..self
        }
    }

    /// The same for state classes.
    pub(crate) fn classes<'s>(&self, stop: &'s dyn Fn() -> bool) -> tpn::Limits<'s> {
        tpn::Limits {
            classes: usize::try_from(self.limits.states).unwrap_or(usize::MAX),
            bytes: usize::try_from(self.limits.bytes).unwrap_or(usize::MAX),
            stop,
        }
    }

    /// The same for markings with places that grow without end.
    pub(crate) fn coverability<'s>(&self, stop: &'s dyn Fn() -> bool) -> coverability::Limits<'s> {
        let usual = coverability::Limits::default();
        let nodes = self.limits.states.min(usual.nodes);
        coverability::Limits { nodes, bytes: self.limits.bytes, stop, ..usual }
    }
}
