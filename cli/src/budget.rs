//! What a search may use, from the command line.

use crate::args::BudgetArgs;
use cotama_verification::limits::Limits;
use std::time::Instant;

/// What a search may use, from now on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    pub(crate) jobs: usize,
    pub(crate) limits: Limits,
}

impl Budget {
    /// The time begins to run.
    pub(crate) fn start(args: BudgetArgs) -> Self {
        let limits = Limits {
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
        Self { limits: Limits { deadline: self.limits.deadline.map(part), ..self.limits }, ..self }
    }
}
