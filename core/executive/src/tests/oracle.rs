//! Response times against a plain simulation, one tick after the other, over the whole hyperperiod.

use super::{hyperperiod, run, small};
use crate::{Overruns, ScheduleError, Task, TaskSet, What};
use cotama_units::units::Micros;
use proptest::prelude::*;
use std::vec;
use std::vec::Vec;

/// The worst response time of the last of these tasks when all are released together, or `None`
/// when one of its jobs is late. It shares nothing with the executive: whoever comes first and has
/// work left, works one tick.
fn worst(tasks: &[Task]) -> Option<u64> {
    let last = tasks.len() - 1;
    let (mut left, mut released, mut worst) = (vec![0; tasks.len()], 0, 0);
    for now in 0..hyperperiod(tasks) {
        for (task, left) in tasks.iter().zip(&mut left) {
            if now % task.period.0 == 0 {
                *left += task.cost.0;
            }
        }
        if now % tasks[last].period.0 == 0 {
            released = now;
        }
        let Some(at_work) = left.iter().position(|&left| left > 0) else { continue };
        left[at_work] -= 1;
        if at_work == last && left[last] == 0 {
            worst = worst.max(now + 1 - released);
        }
        if left[last] > 0 && now + 1 - released >= tasks[last].deadline.0 {
            return None;
        }
    }
    Some(worst)
}

/// The worst time from release to end of each task, late or not, and the first task that missed a
/// deadline.
fn observed<const N: usize>(tasks: [Task; N], needs: [u64; N]) -> ([u64; N], Vec<usize>) {
    let (mut worst, mut released, mut late) = ([0; N], [0; N], vec![]);
    for it in run(tasks, needs, 2 * hyperperiod(&tasks)) {
        match it.what {
            What::Released => released[it.task] = it.at.0,
            What::Done => worst[it.task] = worst[it.task].max(it.at.0 - released[it.task]),
            What::DeadlineMissed => late.push(it.task),
            _ => {}
        }
    }
    (worst, late)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3_000, ..ProptestConfig::default() })]

    #[test]
    fn response_times_are_those_of_a_plain_simulation(tasks in small::<4>()) {
        let set = TaskSet::new(&tasks).unwrap();
        for (at, response) in set.response_times(Overruns::None).enumerate() {
            match (response, worst(&tasks[..=at])) {
                (Ok(response), Some(worst)) => prop_assert_eq!(response.0, worst),
                (Err(ScheduleError::Late { task, .. }), None) => {
                    prop_assert_eq!(task, at);
                    break; // a late one is stopped in the executive and goes on in the simulation
                }
                other => prop_assert!(false, "task {at}: {other:?}"),
            }
        }
    }

    #[test]
    fn the_executive_is_as_late_as_was_computed_and_no_later(tasks in small::<4>()) {
        let (worst, late) = observed(tasks, tasks.map(|task| task.cost.0));
        let set = TaskSet::new(&tasks).unwrap();
        match set.schedulable(Overruns::None) {
            Ok(()) => {
                prop_assert!(late.is_empty());
                let times = set.response_times(Overruns::None);
                let computed: Vec<u64> = times.map(|it| it.unwrap().0).collect();
                prop_assert_eq!(computed, worst);
            }
            Err(ScheduleError::Late { task, .. }) => {
                prop_assert_eq!(late.iter().min(), Some(&task));
            }
            Err(unknown) => prop_assert!(false, "{unknown}"),
        }
    }

    #[test]
    fn an_overrun_takes_the_computed_time(tasks in small::<3>(), one in 0..3_usize) {
        let tasks = tasks.map(|task| Task { patience: u8::MAX, ..task }); // a fault would end it
        let mut needs = tasks.map(|task| task.cost.0);
        needs[one] = u64::MAX;
        let (worst, late) = observed(tasks, needs);
        let set = TaskSet::new(&tasks).unwrap();
        for (at, response) in set.response_times(Overruns::One).enumerate() {
            let late = late.contains(&at);
            let in_time = || !late && worst[at] <= response.unwrap().0;
            prop_assert!(at == one || response.is_err() || in_time());
        }

        // Exact when the overrunning one can use all its extra time: it is in time as a task of its
        // own, with that as cost.
        let mut with = tasks;
        with[one].cost = tasks[one].budget();
        with[one].deadline = Micros(tasks[one].deadline.0 + tasks[one].extra.0);
        let Ok(set) = TaskSet::new(&with) else { return Ok(()) };
        for (at, response) in set.response_times(Overruns::None).enumerate() {
            match response {
                Ok(_) if at == one => {}
                Ok(response) => prop_assert_eq!(worst[at], response.0),
                Err(_) => {
                    prop_assert!(late.contains(&at));
                    break;
                }
            }
        }
    }

    #[test]
    fn the_most_cost_is_the_last_that_a_search_upwards_finds(
        tasks in small::<3>(), task in 0..3_usize
    ) {
        for overruns in [Overruns::None, Overruns::One, Overruns::All] {
            let holds = |cost: &u64| {
                let mut tasks = tasks;
                tasks[task].cost = Micros(*cost);
                TaskSet::new(&tasks).is_ok_and(|set| set.schedulable(overruns).is_ok())
            };
            let found = (1..=tasks[task].deadline.0).filter(holds).max().map(Micros);
            prop_assert_eq!(TaskSet::new(&tasks).unwrap().most_cost(task, overruns), Ok(found));
        }
    }

    #[test]
    fn more_overruns_are_never_better(tasks in small::<4>()) {
        let set = TaskSet::new(&tasks).unwrap();
        let times =
            |overruns| set.response_times(overruns).map(|it| it.map_or(u64::MAX, |it| it.0));
        let [none, one, all] = [Overruns::None, Overruns::One, Overruns::All].map(times);
        for ((none, one), all) in none.zip(one).zip(all) {
            prop_assert!(none <= one && one <= all);
        }
    }
}
