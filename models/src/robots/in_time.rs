//! Whether the modules of each configuration are in time on the robot's computer.

use super::sound::{Places, with_needs};
use super::{Configuration, Module, Robot, members};
use crate::missions::Diagnostic;
use crate::missions::reader::fields::Sink;
use crate::names::quoted;
use cotama_core::executive::{Overruns, ScheduleError, Task, TaskSet};
use cotama_core::units::Micros;

/// Whether all modules of each configuration are done in time, with every parameter as it is where
/// nothing has failed; reports those that may not be. One computer runs them, the most urgent
/// first, and a job is interrupted by a more urgent one (the scheduler of the executive level;
/// exact by response-time analysis, see [`TaskSet::response_times`]).
pub(super) fn is(robot: &Robot, at: &Places, sink: &Sink) -> bool {
    for (number, it) in robot.configurations.iter().enumerate() {
        let (modules, tasks) = tasks(robot, it);
        let Some(late) = late(&modules, &tasks) else { continue };
        let span = at.configurations.get(number).cloned().unwrap_or_default();
        let message = format!("{} is not in time: {late}", quoted(&it.name));
        let it = Diagnostic::new(span, message, "too much for one computer");
        sink.report(it.help("lower a cost or a parameter, or lengthen a period or a deadline"));
    }
    sink.is_empty()
}

/// Returns the modules of a configuration that have a cost, the most urgent first, each as a task.
pub(super) fn tasks<'r>(robot: &'r Robot, it: &Configuration) -> (Vec<&'r Module>, Vec<Task>) {
    let all = with_needs(robot, it.required | it.optional);
    let mut modules: Vec<_> = members(all).filter_map(|it| robot.modules.get(it)).collect();
    modules.sort_by_key(|it| (it.priority, it.deadline));
    let tasks = modules.into_iter().filter_map(|it| {
        let (period, cost) = (it.period?, it.cost?);
        let values = it.parameters.iter().map(|it| it.cost.0.saturating_mul(it.default));
        let cost = values.fold(cost.0, u64::saturating_add);
        let deadline = Micros(it.deadline.unwrap_or(period).0 * 1_000);
        Some((it, Task { deadline, ..Task::new(Micros(period.0 * 1_000), Micros(cost)) }))
    });
    tasks.unzip()
}

/// Says which task can be late, or makes no sense; `None` where all are in time.
fn late(modules: &[&Module], tasks: &[Task]) -> Option<String> {
    let name = |it: usize| quoted(modules.get(it).map_or("", |it| it.name.as_str()));
    match TaskSet::new(tasks).map(|it| it.schedulable(Overruns::None)) {
        Ok(Ok(())) => None,
        Ok(Err(ScheduleError::Late { task, at_least, deadline })) => {
            Some(format!("{} may take {at_least}, and has {deadline}", name(task)))
        }
        Ok(Err(ScheduleError::Unknown { task, at_least })) => {
            Some(format!("{} may take {at_least} or more", name(task)))
        }
        Ok(Err(why)) => Some(why.to_string()),
        Err(it) => {
            let why = it.to_string();
            let why = why.split_once(": ").map_or(why.as_str(), |it| it.1);
            Some(format!("{}: {why}", name(it.task)))
        }
    }
}
