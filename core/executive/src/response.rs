//! Response times: whether each task of a set is in time, whatever happens.

use super::task::{Task, TaskSet};
use cotama_units::units::Micros;

/// Which modules run into their extra time, in each of their periods.
///
/// One that does is not asked to be in time itself, the others are.
///
/// ```
/// use cotama_core::executive::{Overruns, Task, TaskSet};
/// use cotama_core::units::Micros;
///
/// let task = |cost, extra| Task { extra: Micros(extra), ..Task::new(Micros(100), Micros(cost)) };
/// let tasks = [task(10, 5), task(20, 10), task(30, 0)];
/// let set = TaskSet::new(&tasks).unwrap();
/// let last = |overruns| set.response_times(overruns).last().unwrap().unwrap();
/// assert_eq!(last(Overruns::None), Micros(60));
/// assert_eq!(last(Overruns::One), Micros(70));
/// assert_eq!(last(Overruns::All), Micros(75));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overruns {
    /// No tolerance: each job is done within its cost.
    None,
    /// Any one, but one alone: the worst of all choices.
    One,
    /// All that are more urgent than the task looked at.
    All,
}

/// Why a set is not known to be in time.
///
/// ```
/// use cotama_core::executive::{Overruns, Task, TaskSet};
/// use cotama_core::units::Micros;
///
/// let task = |period, cost| Task::new(Micros(period), Micros(cost));
/// let tasks = [task(10, 6), task(20, 9)];
/// let late = TaskSet::new(&tasks).unwrap().schedulable(Overruns::None).unwrap_err();
/// assert_eq!(late.to_string(), "task 1 can miss its deadline, 20 us: it may take 21 us or more");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScheduleError {
    /// A job of this task can miss its deadline.
    Late {
        /// The most urgent one that can.
        task: usize,
        /// Lower bound of the worst response time of the task.
        at_least: Micros,
        /// Deadline of the task.
        deadline: Micros,
    },
    /// The limit of iterations was reached: it may be in time or not.
    Unknown {
        /// The most urgent one of which it is not known.
        task: usize,
        /// Lower bound of the worst response time of the task.
        at_least: Micros,
    },
}

impl core::fmt::Display for ScheduleError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Late { task, at_least, deadline } => {
                write!(
                    f,
                    "task {task} can miss its deadline, {deadline}: it may take {at_least} or more"
                )
            }
            Self::Unknown { task, at_least } => {
                write!(f, "task {task} may take {at_least} or more; allow more iterations to know")
            }
        }
    }
}

impl core::error::Error for ScheduleError {}

impl TaskSet<'_> {
    /// The worst response time of each task, the most urgent first; or that it can be late.
    ///
    /// The least *R* with *R = `C_i` + sum over the more urgent j of ceil(R / `T_j`) `C_j`* (Joseph
    /// and Pandya, "Finding response times in a real-time system", 1986; Audsley et al., "Applying
    /// new scheduling theory to static priority pre-emptive scheduling", 1993), where a task that
    /// overruns has its [budget](Task::budget) in place of its cost. It is the time from release to
    /// end of a job released together with one of each more urgent task, the worst of all cases, so
    /// it is exact whatever the offsets may be; of given offsets it is a bound from above. With
    /// overruns it is exact if the overrunning module can use all its extra time before that ends,
    /// else a bound from above.
    ///
    /// Cost: iterations times tasks each, for [`Overruns::One`] times tasks again.
    pub fn response_times(
        &self,
        overruns: Overruns,
    ) -> impl Iterator<Item = Result<Micros, ScheduleError>> {
        (0..self.tasks().len()).map(move |task| self.worst(task, overruns, None))
    }

    /// Whether every job of every task is in time.
    ///
    /// # Errors
    /// [`ScheduleError`] for the most urgent task that is not known to be.
    pub fn schedulable(&self, overruns: Overruns) -> Result<(), ScheduleError> {
        self.response_times(overruns).try_for_each(|response| response.map(drop))
    }

    /// The largest cost of a task at which every task is in time; `None` when there is none, or no
    /// such task.
    ///
    /// Exact, as more cost never makes a response time shorter: the interval from one microsecond
    /// to the deadline is halved until one is left.
    ///
    /// # Errors
    /// [`ScheduleError::Unknown`] when the limit of iterations was reached on the way.
    pub fn most_cost(
        &self,
        task: usize,
        overruns: Overruns,
    ) -> Result<Option<Micros>, ScheduleError> {
        let Some(of) = self.tasks().get(task) else { return Ok(None) };
        // Invariant: in time with `good`, zero standing for none; not in time with `bad`.
        let (mut good, mut bad) = (0, of.deadline.0.saturating_add(1));
        while bad.saturating_sub(good) > 1 {
            debug_assert!(good < bad, "in time with the one, too late with the other");
            let middle = good.midpoint(bad);
            match self.schedulable_at(overruns, (task, Micros(middle))) {
                Ok(()) => good = middle,
                Err(ScheduleError::Late { .. }) => bad = middle,
                Err(unknown @ ScheduleError::Unknown { .. }) => return Err(unknown),
            }
        }
        Ok((good > 0).then_some(Micros(good)))
    }

    /// Whether every task is in time when one has another cost.
    fn schedulable_at(
        &self,
        overruns: Overruns,
        changed: (usize, Micros),
    ) -> Result<(), ScheduleError> {
        (0..self.tasks().len())
            .try_for_each(|task| self.worst(task, overruns, Some(changed)).map(drop))
    }

    /// The worst response time of a task over all choices of overruns.
    fn worst(
        &self,
        task: usize,
        overruns: Overruns,
        changed: Option<(usize, Micros)>,
    ) -> Result<Micros, ScheduleError> {
        let plain = |at: usize, of: &Task| match changed {
            Some((changed, cost)) if changed == at => cost.0,
            _ => of.cost.0,
        };
        let full = |at, of: &Task| plain(at, of).checked_add(of.extra.0);
        match overruns {
            Overruns::None => self.response(task, |at, of| Some(plain(at, of))),
            Overruns::All => {
                self.response(
                    task,
                    |at, of| if at == task { Some(plain(at, of)) } else { full(at, of) },
                )
            }
            Overruns::One => {
                let mut worst = self.response(task, |at, of| Some(plain(at, of)))?;
                for one in 0..task {
                    let with_one = self.response(task, |at, of| {
                        if at == one { full(at, of) } else { Some(plain(at, of)) }
                    })?;
                    worst = worst.max(with_one);
                }
                Ok(worst)
            }
        }
    }

    /// The response time of a task at given costs; a cost that does not fit is beyond any deadline.
    fn response(
        &self,
        task: usize,
        cost: impl Fn(usize, &Task) -> Option<u64>,
    ) -> Result<Micros, ScheduleError> {
        let deadline = self.tasks().get(task).map_or(Micros::ZERO, |of| of.deadline);
        let mut response = Micros::ZERO;
        for _ in 0..self.iterations {
            let demand = self.tasks().iter().enumerate().take(task.saturating_add(1)).try_fold(
                0_u64,
                |sum, (at, of)| {
                    let jobs = if at == task { 1 } else { jobs(response, of.period) };
                    sum.checked_add(jobs.checked_mul(cost(at, of)?)?)
                },
            );
            let next = match demand {
                Some(next) if next <= deadline.0 => Micros(next),
                // A sum beyond `u64` is beyond any deadline.
                _ => {
                    let at_least = Micros(demand.unwrap_or(u64::MAX));
                    return Err(ScheduleError::Late { task, at_least, deadline });
                }
            };
            debug_assert!(next >= response, "a longer window demands no less");
            if next == response {
                return Ok(response);
            }
            response = next;
        }
        Err(ScheduleError::Unknown { task, at_least: response })
    }
}

/// How many jobs are released in a window that begins with a release; at least that one.
fn jobs(window: Micros, period: Micros) -> u64 {
    debug_assert!(period.0 > 0, "no period of a set is zero");
    let whole = window.0.checked_div(period.0).unwrap_or(u64::MAX); // no period of a set is zero
    let begun = window.0.checked_rem(period.0).is_some_and(|rest| rest > 0);
    whole.saturating_add(u64::from(begun)).max(1)
}
