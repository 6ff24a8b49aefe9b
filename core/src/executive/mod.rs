//! The executive level: periodic modules on one processor, watched by their scheduler.
//!
//! COTAMA (Durand, Godary-Dejean, Lapierre, Passama, Crestani, TAROS 2010) runs the modules of a
//! robot under a scheduler that is also the observer of real-time faults. What of its model is
//! theirs and what is ours:
//!
//! | what | whose |
//! | --- | --- |
//! | each module is periodic and has a watchdog; a job that misses its deadline gets extra time, as the miss may be transient | stated |
//! | after several misses in a row the decisional level gets an event, and answers it | stated |
//! | the control loop of each sub-objective takes less than 100 ms | stated |
//! | a job that ends within its extra time is a miss as well, else a module that is always a little late is never reported | inferred |
//! | a job that is not done when its extra time ends is stopped: *skipped*, it publishes nothing, and consumers see how old the last value is | inferred |
//! | one processor; fixed priorities, preemptive; a loop of modules is one period with priorities in the order of the data | assumed |
//! | a job gets at most *cost + extra* of the processor; then it waits, without the processor, to be skipped | assumed |
//! | a release that finds the last job at work, or the module in fault, is refused: the module sits out one period | assumed |
//!
//! The limit of processor time is what isolates modules from each other: one that hangs takes, in
//! each of its periods, its extra time more than it may, and no more.
//!
//! | type | what it is |
//! | --- | --- |
//! | [`Task`], [`TaskSet`] | modules as the scheduler sees them; a set that makes sense |
//! | [`TaskSet::response_times`] | exact worst-case response times, with no overrun, any one, or all |
//! | [`TaskSet::most_cost`] | how much one of them may cost at most |
//! | [`Executive`] | the scheduler and its watchdogs, driven by time as an argument |
//! | [`Latest`] | data between modules, with its age |
//!
//! **Instants.** A job at work from *a* to *b* has the processor in the half-open interval *[a,
//! b)*, so one that ends when its deadline comes is in time. At one instant jobs end first, then
//! deadlines pass, then extra times end, then jobs are released; within each of these the most
//! urgent task goes first.
//!
//! ```
//! use cotama_core::executive::{Overruns, Task, TaskSet};
//! use cotama_core::units::Micros;
//!
//! // Burns and Wellings, Real-Time Systems and Programming Languages: periods 20, 40 and 80, costs 5, 10 and 40.
//! let task = |period, cost| Task { deadline: Micros(period), ..Task::new(Micros(period), Micros(cost)) };
//! let tasks = [task(20, 5), task(40, 10), task(80, 40)];
//! let set = TaskSet::new(&tasks).unwrap();
//! let responses: Vec<_> = set.response_times(Overruns::None).map(Result::unwrap).collect();
//! assert_eq!(responses, [Micros(5), Micros(15), Micros(80)]);
//! assert_eq!(set.most_cost(1, Overruns::None), Ok(Some(Micros(10)))); // the last one has no slack
//! ```

mod latest;
mod response;
mod scheduler;
mod task;
#[cfg(test)]
mod tests;

pub use latest::{Latest, Publication};
pub use response::{Overruns, Unschedulable};
pub use scheduler::{Executive, Happening, NotRunning, Watchdog, What};
pub use task::{ITERATIONS, Senseless, Task, TaskError, TaskSet};
