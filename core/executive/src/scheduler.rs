//! The scheduler and its watchdogs, as a state machine that is told the time.

use super::latest::Publication;
use super::task::{Task, TaskError, TaskSet};
use cotama_units::units::Micros;

/// State of the watchdog of a module: the places of its net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watchdog {
    /// No job is under way.
    Idle,
    /// A job is, and its deadline is ahead.
    Run,
    /// A job goes on in its extra time.
    Extra,
    /// The fault was reported; the module stands still until the supervisor has reacted.
    Fault,
}

/// An event of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A job was released.
    Released,
    /// A release was refused: a job is under way, or the module is in fault.
    Refused,
    /// The job has used up its cost and its extra time, and gets the processor no more.
    Exhausted,
    /// The job missed its deadline, and gets extra time.
    DeadlineMissed,
    /// The job is done in time.
    Done,
    /// The job is done within its extra time.
    DoneLate {
        /// Whether this is a real-time fault, for the supervisor.
        rt_fault: bool,
    },
    /// The extra time is over: the job is stopped, and publishes nothing.
    Skipped {
        /// Whether this is a real-time fault, for the supervisor.
        rt_fault: bool,
    },
    /// The supervisor has reacted to the fault.
    Acknowledged,
}

/// An event of a module, with its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use = "a fault may have happened"]
pub struct Happening {
    /// Time of the event.
    pub at: Micros,
    /// The place of the module in the set.
    pub task: usize,
    /// The event.
    pub what: What,
}

impl Happening {
    /// The right to publish what the job made, when it is done, late or not.
    pub const fn publication(&self) -> Option<Publication> {
        match self.what {
            What::Done | What::DoneLate { .. } => Some(Publication { at: self.at }),
            _ => None,
        }
    }

    /// Whether it is a real-time fault.
    pub const fn rt_fault(&self) -> bool {
        matches!(self.what, What::DoneLate { rt_fault: true } | What::Skipped { rt_fault: true })
    }
}

/// Why a job cannot be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CompleteError {
    /// This task does not have the processor; the one that has it, if any.
    Running(Option<usize>),
    /// Something was due before: [`Executive::step`] until this instant first.
    Behind(Micros),
}

impl core::fmt::Display for CompleteError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Running(Some(task)) => {
                write!(f, "task {task} has the processor, not this one")
            }
            Self::Running(None) => f.write_str("no task has the processor"),
            Self::Behind(due) => {
                write!(f, "something is due at {due} already; step until then first")
            }
        }
    }
}

impl core::error::Error for CompleteError {}

/// The watchdog and the job of one module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Module {
    pub(super) watchdog: Watchdog,
    /// Deadlines missed in a row; at most the patience of the task.
    pub(super) misses: u8,
    /// Release time of the job under way.
    released: Micros,
    /// Processor time of the job under way; at most the budget of the task, where it is bounded.
    used: Micros,
    /// The next release; `None` when there is none in 64 bits, or the module is stopped.
    pub(super) release: Option<Micros>,
    /// The next job has a deadline and a limit of processor time; so has the job under way.
    pub(super) constrained: bool,
    bounded: bool,
}

/// The scheduler of `N` periodic modules and their watchdogs.
///
/// It is told the time: [`step`](Self::step) hands out what has happened up to it, one happening
/// after the other, and [`wake_at`](Self::wake_at) says when it wants to be told.
/// [`running`](Self::running) says which task has the processor, and [`complete`](Self::complete)
/// that its job is done. The same machine schedules a robot and, with execution times as an
/// argument, a simulation ([`simulate`](Self::simulate)).
///
/// ```
/// use cotama_core::executive::{Executive, Task, What};
/// use cotama_core::units::Micros;
///
/// let ms = |ms: u64| Micros(ms * 1_000);
/// let task = |cost: u64| Task { deadline: ms(80), extra: ms(20), ..Task::new(ms(100), ms(cost)) };
/// let mut executive = Executive::new([task(10), task(50)]).unwrap();
/// let mut said = Vec::new();
/// while let Some(happening) = executive.simulate(ms(300), &[ms(10), ms(75)]) {
///     said.push((happening.at.0 / 1_000, happening.task, happening.what));
/// }
/// let late = |rt_fault| What::Skipped { rt_fault };
/// assert_eq!(said[..6], [(0, 0, What::Released), (0, 1, What::Released), (10, 0, What::Done),
///     (80, 1, What::Exhausted), (80, 1, What::DeadlineMissed), (100, 1, late(false))]);
/// assert!(said.contains(&(300, 1, late(true)))); // the third in a row
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Executive<const N: usize> {
    pub(super) tasks: [Task; N],
    pub(super) modules: [Module; N],
    pub(super) now: Micros,
}

impl<const N: usize> Executive<N> {
    /// At time zero, with nothing released yet; the most urgent task first.
    ///
    /// # Errors
    /// [`TaskError`] for the first task that makes no sense.
    pub fn new(tasks: [Task; N]) -> Result<Self, TaskError> {
        TaskSet::new(&tasks)?;
        let modules = tasks.map(|task| Module {
            watchdog: Watchdog::Idle,
            misses: 0,
            released: Micros::ZERO,
            used: Micros::ZERO,
            release: Some(task.offset),
            constrained: true,
            bounded: true,
        });
        Ok(Self { tasks, modules, now: Micros::ZERO })
    }

    /// The time it was last told.
    pub const fn now(&self) -> Micros {
        self.now
    }

    /// The tasks, the most urgent first.
    pub const fn tasks(&self) -> &[Task; N] {
        &self.tasks
    }

    /// Returns the state of the watchdog of a module; `None` of a task that does not exist.
    pub fn watchdog(&self, task: usize) -> Option<Watchdog> {
        self.modules.get(task).map(|module| module.watchdog)
    }

    /// How many deadlines in a row a module has missed; `None` of a task that is not there.
    pub fn misses(&self, task: usize) -> Option<u8> {
        self.modules.get(task).map(|module| module.misses)
    }

    /// How much processor time the job under way has had; `None` when there is none.
    pub fn used(&self, task: usize) -> Option<Micros> {
        self.modules.get(task).filter(|module| module.is_at_work()).map(|module| module.used)
    }

    /// The task that has the processor: the most urgent one with a job under way and processor time
    /// left.
    pub fn running(&self) -> Option<usize> {
        let wants = |of: &(usize, &Task, &Module)| of.2.wants_processor(of.1);
        self.numbered().find(wants).map(|(at, ..)| at)
    }

    /// When something happens next by itself.
    pub fn wake_at(&self) -> Option<Micros> {
        self.due().map(|(at, ..)| at)
    }

    /// Returns the next event, if it was at `now` or before; `None` when no event is left, and the
    /// time is `now`. A time before the last one counts as the last one.
    pub fn step(&mut self, now: Micros) -> Option<Happening> {
        match self.due() {
            Some((at, task, due)) if at <= now => {
                self.pass(at);
                Some(self.happen(task, due))
            }
            _ => {
                self.pass(now);
                None
            }
        }
    }

    /// The job of this task is done. The instant belongs to the job, so its deadline, when it is
    /// now, is met.
    ///
    /// # Errors
    /// [`CompleteError`] when the task does not have the processor, or the executive was not told
    /// the time so far.
    pub fn complete(&mut self, task: usize, now: Micros) -> Result<Happening, CompleteError> {
        if let Some((due, ..)) = self.due()
            && due < now
        {
            return Err(CompleteError::Behind(due));
        }
        let running = self.running();
        if running != Some(task) {
            return Err(CompleteError::Running(running));
        }
        self.pass(now);
        let at = self.now;
        let (Some(of), Some(module)) = (self.tasks.get(task), self.modules.get_mut(task)) else {
            return Err(CompleteError::Running(running));
        };
        let what = if module.watchdog == Watchdog::Run {
            *module = Module { watchdog: Watchdog::Idle, misses: 0, ..*module };
            What::Done
        } else {
            What::DoneLate { rt_fault: module.end(of) }
        };
        Ok(Happening { at, task, what })
    }

    /// As [`step`](Self::step), with jobs that are done when they have had so much of the
    /// processor, the one under way of each task: for simulations.
    pub fn simulate(&mut self, now: Micros, needs: &[Micros; N]) -> Option<Happening> {
        if let Some(task) = self.running()
            && let (Some(need), Some(module)) = (needs.get(task), self.modules.get(task))
            && let Some(end) = self.now.checked_add(Micros(need.0.saturating_sub(module.used.0)))
            && end <= now
            && self.wake_at().is_none_or(|due| end <= due)
        {
            return self.complete(task, end).ok();
        }
        self.step(now)
    }

    /// The supervisor has reacted to the fault of a module; `None`, and nothing changes, when it
    /// has none now, or something was due before.
    pub fn acknowledge(&mut self, task: usize, now: Micros) -> Option<Happening> {
        if self.wake_at().is_some_and(|due| due < now) {
            return None;
        }
        self.pass(now);
        let module =
            self.modules.get_mut(task).filter(|module| module.watchdog == Watchdog::Fault)?;
        *module = Module { watchdog: Watchdog::Idle, misses: 0, ..*module };
        Some(Happening { at: self.now, task, what: What::Acknowledged })
    }

    /// All tasks and their modules, by number. A range, as the compiler sees that it does not
    /// overflow.
    fn numbered(&self) -> impl Iterator<Item = (usize, &Task, &Module)> {
        (0..N).zip(&self.tasks).zip(&self.modules).map(|((at, task), module)| (at, task, module))
    }

    /// Returns the next due event: the earliest, of these the first kind, of these the most urgent
    /// task.
    fn due(&self) -> Option<(Micros, usize, Due)> {
        let running = self.running();
        let mut first: Option<(Micros, usize, Due)> = None;
        for (at, task, module) in self.numbered() {
            let exhausted = (running == Some(at) && module.bounded)
                .then(|| {
                    self.now.checked_add(Micros(task.budget().0.saturating_sub(module.used.0)))
                })
                .flatten();
            let deadline = (module.watchdog == Watchdog::Run && module.bounded)
                .then(|| module.released.checked_add(task.deadline))
                .flatten();
            // Fits, in a task that makes sense.
            debug_assert!(!task.is_senseless(), "the task of a set makes sense");
            let end = Micros(task.deadline.0.saturating_add(task.extra.0));
            let extra = (module.watchdog == Watchdog::Extra)
                .then(|| module.released.checked_add(end))
                .flatten();
            let dues = [
                (Due::Exhausted, exhausted),
                (Due::Deadline, deadline),
                (Due::ExtraOver, extra),
                (Due::Release, module.release),
            ];
            for &(kind, when) in &dues {
                if let Some(when) = when
                    && first.is_none_or(|(least, _, of)| (when, kind) < (least, of))
                {
                    first = Some((when, at, kind));
                }
            }
        }
        // An event due in the past happens now: an acknowledgement or an end was reported late.
        first.map(|(when, at, kind)| (when.max(self.now), at, kind))
    }

    /// Lets what is due happen now.
    fn happen(&mut self, task: usize, due: Due) -> Happening {
        let now = self.now;
        debug_assert!(task < N, "a task of this executive is due");
        let mut what = What::Exhausted;
        if let (Some(of), Some(module)) = (self.tasks.get(task), self.modules.get_mut(task)) {
            what = match due {
                Due::Exhausted => What::Exhausted,
                Due::Deadline => {
                    module.watchdog = Watchdog::Extra;
                    debug_assert!(module.misses < of.patience, "one more miss is no fault yet");
                    // The count is below the patience outside `Fault`.
                    module.misses = module.misses.saturating_add(1).min(of.patience);
                    What::DeadlineMissed
                }
                Due::ExtraOver => What::Skipped { rt_fault: module.end(of) },
                Due::Release => {
                    module.release = module.release.and_then(|at| at.checked_add(of.period));
                    if module.watchdog == Watchdog::Idle {
                        debug_assert!(module.misses < of.patience, "an idle module has no fault");
                        *module = Module {
                            watchdog: Watchdog::Run,
                            released: now,
                            used: Micros::ZERO,
                            bounded: module.constrained,
                            ..*module
                        };
                        What::Released
                    } else {
                        What::Refused
                    }
                }
            };
        }
        Happening { at: now, task, what }
    }

    /// Lets time pass, during which nothing is due: the job that has the processor uses it.
    pub(super) fn pass(&mut self, now: Micros) {
        let passed = now.0.saturating_sub(self.now.0);
        debug_assert!(self.wake_at().is_none_or(|due| now <= due), "nothing due is passed over");
        let running = self.running().and_then(|task| self.modules.get_mut(task));
        if let Some(module) = running {
            // No more than is left of the budget.
            debug_assert!(module.used.0.checked_add(passed).is_some(), "it fits its budget");
            module.used = Micros(module.used.0.saturating_add(passed));
        }
        self.now = self.now.max(now);
    }
}

impl Module {
    const fn is_at_work(&self) -> bool {
        matches!(self.watchdog, Watchdog::Run | Watchdog::Extra)
    }

    const fn wants_processor(&self, task: &Task) -> bool {
        self.is_at_work() && (!self.bounded || self.used.0 < task.budget().0)
    }

    /// Ends a late job; whether that is a fault.
    const fn end(&mut self, task: &Task) -> bool {
        debug_assert!(self.is_at_work(), "a job ends that has begun");
        let rt_fault = self.misses >= task.patience;
        self.watchdog = if rt_fault { Watchdog::Fault } else { Watchdog::Idle };
        rt_fault
    }
}

/// Kinds of due events, in the order in which they happen at one instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Due {
    Exhausted,
    Deadline,
    ExtraOver,
    Release,
}
