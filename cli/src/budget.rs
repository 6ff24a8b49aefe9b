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

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn megabytes_are_bytes_and_a_share_is_a_part_of_the_time_that_is_left() {
        let args = BudgetArgs { max_states: None, max_memory: 3, max_seconds: None, jobs: 2 };
        let budget = Budget::start(args);
        assert_eq!((budget.limits.bytes, budget.jobs), (3 << 20, 2));
        assert_eq!(budget.share(5).limits.deadline, None);
        let deadline = Instant::now() + Duration::from_secs(1_000);
        let budget =
            Budget { limits: Limits { deadline: Some(deadline), ..budget.limits }, ..budget };
        let left = |of| budget.share(of).limits.deadline.unwrap() - Instant::now();
        assert!((190..=200).contains(&left(5).as_secs()), "{:?}", left(5));
        assert!((990..=1_000).contains(&left(1).as_secs()), "{:?}", left(1));
        assert!((990..=1_000).contains(&left(0).as_secs()), "{:?}", left(0));
    }
}
