//! Response times that are printed in books.

use super::task;
use crate::{Overruns, ScheduleError, Senseless, Task, TaskError, TaskSet};
use cotama_units::units::Micros;
use std::string::ToString;
use std::vec::Vec;

fn responses(tasks: &[Task]) -> Vec<u64> {
    let set = TaskSet::new(tasks).unwrap();
    set.response_times(Overruns::None).map(|response| response.unwrap().0).collect()
}

#[test]
fn burns_and_wellings_set_a_is_late() {
    let tasks = [task(30, 30, 10, 0), task(40, 40, 10, 0), task(50, 50, 12, 0)];
    let late = ScheduleError::Late { task: 2, at_least: Micros(52), deadline: Micros(50) };
    assert_eq!(TaskSet::new(&tasks).unwrap().schedulable(Overruns::None), Err(late));
    assert_eq!(late.to_string(), "task 2 can miss its deadline, 50 us: it may take 52 us or more");
}

#[test]
fn burns_and_wellings_set_b_and_set_c() {
    assert_eq!(
        responses(&[task(16, 16, 4, 0), task(40, 40, 5, 0), task(80, 80, 32, 0)]),
        [4, 9, 58]
    );
    assert_eq!(
        responses(&[task(20, 20, 5, 0), task(40, 40, 10, 0), task(80, 80, 40, 0)]),
        [5, 15, 80]
    );
}

#[test]
fn burns_and_wellings_deadlines_before_periods() {
    let tasks = [task(20, 5, 3, 0), task(15, 7, 3, 0), task(10, 10, 4, 0), task(20, 20, 3, 0)];
    assert_eq!(responses(&tasks), [3, 6, 10, 20]);
}

#[test]
fn lehoczky_sha_and_ding() {
    // The exact characterisation of rate monotonic scheduling (1989): beyond the bound of
    // utilisation, yet in time.
    let tasks = |first| [task(100, 100, first, 0), task(150, 150, 40, 0), task(350, 350, 100, 0)];
    assert_eq!(responses(&tasks(20)), [20, 60, 240]);
    assert_eq!(responses(&tasks(40)), [40, 80, 300]);
}

#[test]
fn the_most_cost_of_a_task_is_exact() {
    let tasks = [task(100, 100, 20, 0), task(150, 150, 40, 0), task(350, 350, 100, 0)];
    let set = TaskSet::new(&tasks).unwrap();
    // More than 40 of the first carry the last one beyond 300, into a fourth job of it, and beyond
    // 350; with 160 of its own the last one is done at 300, and would not be by 350 if it were not.
    assert_eq!(set.most_cost(0, Overruns::None), Ok(Some(Micros(40))));
    assert_eq!(set.most_cost(2, Overruns::None), Ok(Some(Micros(160))));
    assert_eq!(set.most_cost(3, Overruns::None), Ok(None));
}

#[test]
fn with_all_overruns_those_above_take_their_extra_time_and_the_task_its_cost() {
    let tasks = [task(10, 10, 2, 1), task(20, 20, 4, 3), task(20, 20, 1, 9)];
    let set = TaskSet::new(&tasks).unwrap();
    let times = |overruns| set.response_times(overruns).map(|it| it.unwrap().0).collect::<Vec<_>>();
    assert_eq!(times(Overruns::None), [2, 6, 7]);
    assert_eq!(times(Overruns::One), [2, 7, 10]);
    // 3 + 7 + 1 is beyond the second release of the first.
    assert_eq!(times(Overruns::All), [2, 7, 14]);
}

#[test]
fn a_limit_of_iterations_is_an_answer() {
    let tasks = [task(2, 2, 1, 0), task(1_000, 1_000, 400, 0)];
    let set = TaskSet::new(&tasks).unwrap();
    assert_eq!(set.schedulable(Overruns::None), Ok(()));
    let unknown = ScheduleError::Unknown { task: 1, at_least: Micros(701) };
    assert_eq!(set.with_iterations(3).schedulable(Overruns::None), Err(unknown));
    assert!(set.with_iterations(3).most_cost(1, Overruns::None).is_err());
    assert_eq!(
        unknown.to_string(),
        "task 1 may take 701 us or more; allow more iterations to know"
    );
}

#[test]
fn a_response_beyond_64_bits_is_late() {
    let huge = u64::MAX / 2;
    let tasks = [
        task(huge, huge, huge, 0),
        task(u64::MAX, u64::MAX, huge, 0),
        task(u64::MAX, u64::MAX, huge, 0),
    ];
    let late =
        ScheduleError::Late { task: 1, at_least: Micros(u64::MAX), deadline: Micros(u64::MAX) };
    assert_eq!(TaskSet::new(&tasks).unwrap().schedulable(Overruns::All), Err(late));
}

#[test]
fn tasks_that_make_no_sense_are_refused() {
    let why = |task: Task| match TaskSet::new(&[task]) {
        Err(TaskError { task: 0, why }) => why,
        other => panic!("{other:?}"),
    };
    assert_eq!(why(task(0, 0, 1, 1)), Senseless::NoPeriod);
    assert_eq!(why(task(5, 5, 0, 0)), Senseless::NoCost);
    assert_eq!(why(Task { patience: 0, ..task(5, 5, 1, 0) }), Senseless::NoPatience);
    assert_eq!(why(task(5, 4, 7, 2)), Senseless::NeverDone { cost: Micros(7), end: Micros(6) });
    let after = Senseless::DeadlineAfterPeriod { deadline: Micros(6), period: Micros(5) };
    assert_eq!(why(task(5, 6, 1, 0)), after);
    assert_eq!(why(task(5, 5, 1, u64::MAX)), Senseless::TooLong);
    let error = TaskSet::new(&[task(5, 5, 1, 0), task(5, 6, 1, 0)]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "task 1: its deadline, 6 us, is after its period, 5 us; at most the period is meant"
    );
}
