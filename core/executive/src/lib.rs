//! The executive level: periodic modules on one processor, watched by their scheduler.
//!
//! COTAMA (Durand, Godary-Dejean, Lapierre, Passama, Crestani, TAROS 2010) runs the modules of a
//! robot under a scheduler that is also the observer of real-time faults. They state:
//!
//! - Each module is periodic and has a watchdog. A job that misses its deadline gets extra time, as
//!   the miss may be transient.
//! - After several misses in a row the decisional level gets an event, and answers it.
//! - The control loop of each sub-objective takes less than 100 ms.
//!
//! From what they state we infer:
//!
//! - A job that ends within its extra time is a miss as well. Otherwise a module that is always a
//!   little late is never reported.
//! - A job that is not done when its extra time ends is stopped: it is *skipped* and publishes
//!   nothing. Consumers see how old the last value is.
//!
//! We assume:
//!
//! - There is one processor, with fixed priorities, preemptive. A loop of modules is one period
//!   with priorities in the order of the data.
//! - A job gets at most *cost + extra* of the processor. Then it waits, without the processor, to
//!   be skipped.
//! - A release that finds the last job at work, or the module in fault, is refused: the module sits
//!   out one period.
//!
//! The limit of processor time is what isolates modules from each other: one that hangs takes, in
//! each of its periods, its extra time more than it may, and no more.
//!
//! | type | what it is |
//! | --- | --- |
//! | [`Task`], [`TaskSet`] | modules as the scheduler sees them; a set that makes sense |
//! | [`TaskSet::response_times`] | exact worst-case response times, with overruns or without |
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
//! // Burns and Wellings, Real-Time Systems and Programming Languages.
//! let task = |period, cost| {
//!     Task { deadline: Micros(period), ..Task::new(Micros(period), Micros(cost)) }
//! };
//! let tasks = [task(20, 5), task(40, 10), task(80, 40)]; // periods and costs
//! let set = TaskSet::new(&tasks).unwrap();
//! let responses: Vec<_> = set.response_times(Overruns::None).map(Result::unwrap).collect();
//! assert_eq!(responses, [Micros(5), Micros(15), Micros(80)]);
//! assert_eq!(set.most_cost(1, Overruns::None), Ok(Some(Micros(10)))); // the last one has no slack
//! ```
#![no_std]
#![cfg_attr(any(test, kani), allow(clippy::pedantic))]

#[cfg(test)]
extern crate std;

mod latest;
#[cfg(kani)]
pub mod proofs;
mod requests;
mod response;
mod scheduler;
mod task;
#[cfg(test)]
mod tests;

pub use latest::{Latest, Publication};
pub use requests::Request;
pub use response::{Overruns, ScheduleError};
pub use scheduler::{CompleteError, Executive, Happening, Watchdog, What};
pub use task::{ITERATIONS, Senseless, Task, TaskError, TaskSet};
