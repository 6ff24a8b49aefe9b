//! The roots of the executive level: scheduler, watchdogs, response times and published values, for
//! any tasks.
//!
//! An executive comes as its caller can leave it at worst: at any time, with any jobs under way.

use cotama_core::executive::{
    CompleteError, Executive, Happening, Latest, Overruns, Request, ScheduleError, Task, TaskError,
    TaskSet, Watchdog,
};
use cotama_core::units::Micros;

/// Modules of a control loop.
const N: usize = 8;

#[unsafe(no_mangle)]
fn root_executive_new(tasks: [Task; N]) -> Result<Executive<N>, TaskError> {
    Executive::new(tasks)
}

#[unsafe(no_mangle)]
fn root_executive_step(executive: &mut Executive<N>, now: Micros) -> Option<Happening> {
    executive.step(now)
}

#[unsafe(no_mangle)]
fn root_executive_complete(
    executive: &mut Executive<N>,
    task: usize,
    now: Micros,
) -> Result<Happening, CompleteError> {
    executive.complete(task, now)
}

#[unsafe(no_mangle)]
fn root_executive_simulate(
    executive: &mut Executive<N>,
    now: Micros,
    needs: &[Micros; N],
) -> Option<Happening> {
    executive.simulate(now, needs)
}

#[unsafe(no_mangle)]
fn root_executive_acknowledge(
    executive: &mut Executive<N>,
    task: usize,
    now: Micros,
) -> Option<Happening> {
    executive.acknowledge(task, now)
}

#[unsafe(no_mangle)]
fn root_executive_wake_at(executive: &Executive<N>) -> (Option<Micros>, Option<usize>) {
    (executive.wake_at(), executive.running())
}

#[unsafe(no_mangle)]
fn root_executive_latest(
    latest: &mut Latest<u32>,
    done: &Happening,
    now: Micros,
) -> Option<Micros> {
    latest.publish(done.publication()?, 1);
    latest.read(now).map(|(_, age)| age)
}

#[unsafe(no_mangle)]
fn root_executive_schedulable(
    tasks: &[Task],
    overruns: Overruns,
) -> Option<Result<(), ScheduleError>> {
    Some(TaskSet::new(tasks).ok()?.schedulable(overruns))
}

#[unsafe(no_mangle)]
fn root_executive_most_cost(
    tasks: &[Task],
    task: usize,
) -> Option<Result<Option<Micros>, ScheduleError>> {
    Some(TaskSet::new(tasks).ok()?.most_cost(task, Overruns::One))
}

#[unsafe(no_mangle)]
fn root_executive_request(
    executive: &mut Executive<N>,
    task: usize,
    request: Request,
    now: Micros,
) -> (bool, Option<Watchdog>) {
    (executive.request(task, request, now), executive.watchdog(task))
}

#[unsafe(no_mangle)]
fn root_executive_task(period: Micros, cost: Micros, any: &Task) -> (Task, Micros) {
    (Task::new(period, cost), any.budget())
}
