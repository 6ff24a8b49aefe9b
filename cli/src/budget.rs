//! The budget of a search, from the command line.

use crate::args::BudgetArgs;
use cotama_verification::limits::Limits;
use std::time::{Duration, Instant};

/// The budget of a search, from now on.
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

    /// To be divided among so many questions, asked one after the other.
    pub(crate) const fn among(self, questions: usize) -> Shares {
        Shares { budget: self, questions }
    }
}

/// A budget for questions that are asked one after the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shares {
    budget: Budget,
    /// So many are still to be asked.
    questions: usize,
}

impl Shares {
    /// The budget of the next question: all of it, with an even part of the time that is left.
    pub(crate) fn next(&mut self) -> Budget {
        let now = Instant::now();
        let part = |it: Instant| now + self.part(it.saturating_duration_since(now));
        let deadline = self.budget.limits.deadline.map(part);
        self.questions = self.questions.saturating_sub(1);
        Budget { limits: Limits { deadline, ..self.budget.limits }, ..self.budget }
    }

    /// Returns the part of the time left that the next question may take; all of it if it is the
    /// last.
    fn part(&self, left: Duration) -> Duration {
        left / u32::try_from(self.questions.max(1)).unwrap_or(u32::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn megabytes_are_bytes_and_a_share_is_a_part_of_the_time_that_is_left() {
        let args = BudgetArgs { max_states: None, max_memory: 3, max_seconds: None, jobs: 2 };
        let budget = Budget::start(args);
        assert_eq!((budget.limits.bytes, budget.jobs), (3 << 20, 2));
        assert_eq!(budget.among(5).next().limits.deadline, None);
        let deadline = Instant::now() + Duration::from_secs(1_000);
        let budget =
            Budget { limits: Limits { deadline: Some(deadline), ..budget.limits }, ..budget };
        let left = |of| budget.among(of).next().limits.deadline.unwrap() - Instant::now();
        assert!((190..=200).contains(&left(5).as_secs()), "{:?}", left(5));
        assert!((990..=1_000).contains(&left(1).as_secs()), "{:?}", left(1));
        assert!((990..=1_000).contains(&left(0).as_secs()), "{:?}", left(0));
    }

    /// 120 s for four: the second takes no time, and its 30 s are for the third and the fourth.
    #[test]
    fn time_left_by_a_question_is_shared_equally_by_the_later_ones() {
        let args = BudgetArgs { max_states: None, max_memory: 3, max_seconds: None, jobs: 2 };
        let mut shares = Budget::start(args).among(4);
        let mut left = 120;
        let parts = [30, 0, 45, 45].map(|taken| {
            let part = shares.part(Duration::from_secs(left)).as_secs();
            shares.next();
            left -= taken;
            part
        });
        assert_eq!((parts, left), ([30, 30, 45, 45], 0));
        // There are no more, and none is refused.
        assert_eq!(shares.part(Duration::from_secs(7)).as_secs(), 7);
    }
}
