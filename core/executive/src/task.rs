//! A periodic module as the scheduler sees it, and sets of them that make sense.

use cotama_units::units::Micros;

/// The most iterations for one response time, where nothing else is said. Each lengthens it by at
/// least one microsecond, most by a whole job; a set of twenty tasks rarely needs fifty.
pub const ITERATIONS: u32 = 10_000;

/// A periodic module. Of two tasks of a set the earlier one is the more urgent.
///
/// ```
/// use cotama_core::executive::Task;
/// use cotama_core::units::Micros;
///
/// let avoid = Task::new(Micros(50_000), Micros(8_000));
/// assert_eq!((avoid.deadline, avoid.patience), (Micros(50_000), 3));
/// let tolerant = Task { deadline: Micros(20_000), extra: Micros(2_000), ..avoid };
/// assert_eq!(tolerant.budget(), Micros(10_000));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Task {
    /// From one release to the next.
    pub period: Micros,
    /// From a release until its job must be done; at most the period.
    pub deadline: Micros,
    /// When the first job is released.
    pub offset: Micros,
    /// The most processor time that a job needs: its worst-case execution time.
    pub cost: Micros,
    /// How long after its deadline a late job may still go on, and how much processor time beyond
    /// its cost a job gets.
    pub extra: Micros,
    /// So many misses in a row are a fault; at least one.
    pub patience: u8,
}

impl Task {
    /// Misses in a row that are a fault, where nothing else is said; assumed, COTAMA's paper says
    /// "several".
    pub const PATIENCE: u8 = 3;

    /// A task that must be done before its next release, first released at the start, without extra
    /// time.
    #[must_use]
    pub const fn new(period: Micros, cost: Micros) -> Self {
        Self {
            period,
            deadline: period,
            offset: Micros::ZERO,
            cost,
            extra: Micros::ZERO,
            patience: Self::PATIENCE,
        }
    }

    /// The most processor time that a job gets: cost and extra time. It fits in a task that makes
    /// sense.
    #[must_use]
    pub const fn budget(&self) -> Micros {
        Micros(self.cost.0.saturating_add(self.extra.0))
    }

    pub(super) const fn is_senseless(&self) -> bool {
        self.flaw().is_some()
    }

    /// Why it makes no sense, if it does not.
    const fn flaw(&self) -> Option<Senseless> {
        let Some(end) = self.deadline.checked_add(self.extra) else {
            return Some(Senseless::TooLong);
        };
        if self.period.0 == 0 {
            Some(Senseless::NoPeriod)
        } else if self.cost.0 == 0 {
            Some(Senseless::NoCost)
        } else if self.patience == 0 {
            Some(Senseless::NoPatience)
        } else if self.deadline.0 > self.period.0 {
            Some(Senseless::DeadlineAfterPeriod { deadline: self.deadline, period: self.period })
        } else if self.cost.0 > end.0 {
            Some(Senseless::NeverDone { cost: self.cost, end })
        } else if self.cost.checked_add(self.extra).is_none() {
            Some(Senseless::TooLong)
        } else {
            None
        }
    }
}

/// Why a task makes no sense.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Senseless {
    /// The period is zero.
    NoPeriod,
    /// The cost is zero.
    NoCost,
    /// No number of misses would not be a fault.
    NoPatience,
    /// The deadline comes after the next release.
    DeadlineAfterPeriod {
        /// The deadline.
        deadline: Micros,
        /// The period.
        period: Micros,
    },
    /// A job with the processor for itself would be skipped: its cost is beyond deadline and extra
    /// time.
    NeverDone {
        /// The cost.
        cost: Micros,
        /// Deadline and extra time.
        end: Micros,
    },
    /// Deadline or cost, and extra time, do not fit 64 bits.
    TooLong,
}

/// A task that makes no sense, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TaskError {
    /// Position of the task in the set.
    pub task: usize,
    /// The reason.
    pub why: Senseless,
}

impl core::fmt::Display for TaskError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "task {}: ", self.task)?;
        match self.why {
            Senseless::NoPeriod => {
                f.write_str("its period is zero; give the time from release to release")
            }
            Senseless::NoCost => {
                f.write_str("its cost is zero; give its worst-case execution time")
            }
            Senseless::NoPatience => {
                f.write_str("zero misses in a row are no fault; give at least one")
            }
            Senseless::DeadlineAfterPeriod { deadline, period } => {
                write!(
                    f,
                    "its deadline, {deadline}, is after its period, {period}; \
                     at most the period is meant"
                )
            }
            Senseless::NeverDone { cost, end } => {
                write!(
                    f,
                    "its cost, {cost}, is above deadline and extra time, {end}; \
                     no job would ever be done"
                )
            }
            Senseless::TooLong => f.write_str(
                "deadline or cost, with the extra time, does not fit 64 bits of microseconds",
            ),
        }
    }
}

impl core::error::Error for TaskError {}

/// Tasks that make sense, the most urgent first.
///
/// ```
/// use cotama_core::executive::{Task, TaskSet};
/// use cotama_core::units::Micros;
///
/// let task = Task::new(Micros(100), Micros(20));
/// assert_eq!(TaskSet::new(&[task]).unwrap().tasks().len(), 1);
/// let late = Task { deadline: Micros(150), ..task };
/// let error = TaskSet::new(&[task, late]).unwrap_err();
/// assert_eq!(error.task, 1);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TaskSet<'t> {
    tasks: &'t [Task],
    pub(super) iterations: u32,
}

impl<'t> TaskSet<'t> {
    /// These tasks, the most urgent first.
    ///
    /// # Errors
    /// [`TaskError`] for the first one that makes no sense.
    pub fn new(tasks: &'t [Task]) -> Result<Self, TaskError> {
        match tasks.iter().enumerate().find_map(|(at, task)| Some((at, task.flaw()?))) {
            Some((task, why)) => Err(TaskError { task, why }),
            None => Ok(Self { tasks, iterations: ITERATIONS }),
        }
    }

    /// The same, with another limit of iterations for each response time; see [`ITERATIONS`].
    #[must_use]
    pub const fn with_iterations(mut self, iterations: u32) -> Self {
        self.iterations = iterations;
        self
    }

    /// The tasks.
    #[must_use]
    pub const fn tasks(&self) -> &'t [Task] {
        self.tasks
    }
}
