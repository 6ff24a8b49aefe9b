//! Promises of the watchdogs: faults after so many misses in a row, isolation, and data that shows
//! its age.

use super::{run, task};
use crate::{Executive, Happening, Latest, Overruns, Publication, Task, TaskSet, Watchdog, What};
use cotama_units::units::Micros;
use proptest::prelude::*;
use std::vec::Vec;

/// Lets a set run with execution times of its own for each job, shown every happening; faults are
/// acknowledged one tick after the next release would have been.
fn play<const N: usize>(
    tasks: [Task; N],
    needs: &[[u64; N]],
    mut shown: impl FnMut(&Executive<N>, Happening),
) {
    let mut executive = Executive::new(tasks).unwrap();
    let mut at = [0; N];
    let need =
        |at: &[usize; N]| core::array::from_fn(|task| Micros(needs[at[task] % needs.len()][task]));
    for now in 0..400 {
        while let Some(it) = executive.simulate(Micros(now), &need(&at)) {
            shown(&executive, it);
            match it.what {
                What::Done | What::DoneLate { .. } | What::Skipped { .. } => at[it.task] += 1,
                _ => {}
            }
        }
        for task in 0..N {
            if now % 7 == 0
                && let Some(it) = executive.acknowledge(task, Micros(now))
            {
                shown(&executive, it);
            }
        }
    }
}

fn needs() -> impl Strategy<Value = Vec<[u64; 3]>> {
    proptest::collection::vec(proptest::array::uniform3(0..20_u64), 1..40)
}

fn three() -> [Task; 3] {
    [task(10, 6, 2, 2), task(15, 12, 4, 3), task(20, 20, 5, 5)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1_000, ..ProptestConfig::default() })]

    /// WD1, WD2, WD3 and WD6.
    #[test]
    fn a_fault_comes_with_the_last_of_so_many_misses_in_a_row_and_only_then(needs in needs()) {
        let mut in_a_row = [0; 3];
        play(three(), &needs, |executive, it| {
            let misses = &mut in_a_row[it.task];
            match it.what {
                What::DeadlineMissed => *misses += 1,
                What::Done | What::Acknowledged => *misses = 0,
                What::DoneLate { rt_fault } | What::Skipped { rt_fault } => {
                    assert_eq!(rt_fault, *misses == Task::PATIENCE, "{it:?}");
                    assert_eq!(it.rt_fault(), executive.watchdog(it.task) == Some(Watchdog::Fault));
                }
                _ => {}
            }
            assert_eq!(executive.misses(it.task), Some(*misses));
        });
    }

    /// WD4: whatever jobs need, a module takes in each of its periods no more than its cost and its
    /// extra time.
    #[test]
    fn a_module_takes_no_more_than_its_budget_in_each_of_its_periods(needs in needs()) {
        let (mut running, mut since, mut used) = (None, 0, [0; 3]);
        play(three(), &needs, |executive, it| {
            if let Some(task) = running {
                used[task] += it.at.0 - since;
            }
            assert!(used[it.task] <= executive.tasks()[it.task].budget().0);
            if it.what == What::Released {
                used[it.task] = 0;
            }
            (running, since) = (executive.running(), it.at.0);
        });
    }

    /// WD4 for a control loop, the modules of which share their period: each is at most the extra
    /// time later.
    #[test]
    fn in_a_loop_one_overrunning_module_delays_the_others_by_at_most_its_extra_time(
        costs in proptest::array::uniform4(1..20_u64),
        extra in 0..10_u64,
        one in 0..4_usize,
        need in 0..200_u64
    ) {
        let tasks = costs.map(|cost| task(100, 90, cost, extra));
        let ends = |needs| {
            let done = run(tasks, needs, 100).into_iter().filter(|it| it.what == What::Done);
            done.collect::<Vec<_>>()
        };
        let mut with = costs;
        with[one] = costs[one].max(need);
        for end in ends(with).iter().filter(|end| end.task != one) {
            let plain = ends(costs).iter().find(|plain| plain.task == end.task).unwrap().at;
            prop_assert!(plain <= end.at && end.at.0 - plain.0 <= extra);
        }
    }

    /// WD5.
    #[test]
    fn a_skipped_job_publishes_nothing_and_its_consumers_see_the_age(needs in needs()) {
        let mut mail = [Latest::empty(); 3];
        let mut last = [None; 3];
        let mut number = 0;
        play(three(), &needs, |_, it| {
            let before = mail[it.task];
            number += 1;
            if let Some(publication) = it.publication() {
                mail[it.task].publish(publication, number);
                last[it.task] = Some((number, it.at.0));
            }
            if matches!(it.what, What::Skipped { .. }) {
                assert_eq!(mail[it.task], before);
            }
            let later = Micros(it.at.0 + 3);
            let seen = mail[it.task].read(later).map(|(&number, age)| (number, later.0 - age.0));
            assert_eq!(seen, last[it.task]);
        });
    }
}

#[test]
fn with_unequal_periods_an_overrun_costs_more_than_the_extra_time() {
    // Two ticks of extra time carry the last job beyond the second release of the first one.
    let tasks = [task(10, 10, 3, 0), task(20, 20, 2, 2), task(20, 20, 4, 0)];
    let times = |overruns| {
        let set = TaskSet::new(&tasks).unwrap();
        set.response_times(overruns).map(|it| it.unwrap().0).collect::<Vec<_>>()
    };
    assert_eq!(times(Overruns::None), [3, 5, 9]);
    assert_eq!(times(Overruns::One), [3, 5, 14]);
}

#[test]
fn a_job_done_at_its_deadline_sharp_is_in_time_and_one_at_the_end_of_its_extra_time_is_late() {
    let ends = |need| {
        run([task(10, 6, 2, 4)], [need], 10)
            .into_iter()
            .map(|it| (it.at.0, it.what))
            .collect::<Vec<_>>()
    };
    assert_eq!(ends(6), [(0, What::Released), (6, What::Done), (10, What::Released)]);
    let mut executive = Executive::new([task(10, 3, 3, 4)]).unwrap();
    assert_eq!(executive.step(Micros(0)).unwrap().what, What::Released);
    assert_eq!(executive.step(Micros(6)).unwrap().what, What::DeadlineMissed);
    assert_eq!(executive.step(Micros(6)), None);
    assert_eq!(executive.complete(0, Micros(7)).unwrap().what, What::DoneLate { rt_fault: false });
}

#[test]
fn a_release_is_refused_while_the_last_job_is_under_way() {
    let whats: Vec<_> = run([task(10, 10, 5, 2)], [u64::MAX], 20)
        .into_iter()
        .map(|it| (it.at.0, it.what))
        .collect();
    let expected = [
        (0, What::Released),
        (7, What::Exhausted),
        (10, What::DeadlineMissed),
        (10, What::Refused),
        (12, What::Skipped { rt_fault: false }),
        (20, What::Released),
    ];
    assert_eq!(whats, expected);
}

/// Order at one instant: exhausted jobs, then deadlines, ends of extra time, releases; of one kind
/// the more urgent task first.
#[test]
fn events_due_at_one_instant_happen_by_kind_and_then_by_task() {
    let whats = |tasks, needs, until| {
        let all = run(tasks, needs, until).into_iter();
        all.map(|it| (it.at.0, it.task, it.what)).collect::<Vec<_>>()
    };
    let skipped = What::Skipped { rt_fault: false };
    let two = [task(10, 10, 1, 0), task(40, 10, 12, 5)];
    let expected = [
        (0, 0, What::Released),
        (0, 1, What::Released),
        (1, 0, What::Done),
        (10, 1, What::DeadlineMissed),
        (10, 0, What::Released),
        (11, 0, What::Done),
        (15, 1, skipped),
        (20, 0, What::Released),
    ];
    assert_eq!(whats(two, [1, u64::MAX], 20), expected);
    let expected = [
        (0, 0, What::Released),
        (0, 1, What::Released),
        (10, 0, What::Exhausted),
        (10, 0, What::DeadlineMissed),
        (10, 1, What::DeadlineMissed),
        (10, 0, skipped),
        (10, 1, skipped),
        (10, 0, What::Released),
        (10, 1, What::Released),
    ];
    assert_eq!(whats([task(10, 10, 10, 0); 2], [u64::MAX; 2], 10), expected);
}

#[test]
fn a_value_that_is_just_as_old_as_allowed_is_read() {
    let mut mail = Latest::empty();
    mail.publish(Publication { at: Micros(50) }, "here");
    assert_eq!(mail.read_within(Micros(60), Micros(10)), Some(&"here"));
    assert_eq!(mail.read_within(Micros(61), Micros(10)), None);
}

#[test]
fn only_a_job_that_is_done_publishes_and_only_a_fault_is_acknowledged() {
    let all = [
        (What::Released, false),
        (What::Refused, false),
        (What::Exhausted, false),
        (What::DeadlineMissed, false),
        (What::Done, true),
        (What::DoneLate { rt_fault: false }, true),
        (What::Skipped { rt_fault: true }, false),
        (What::Acknowledged, false),
    ];
    for (what, publishes) in all {
        let it = Happening { at: Micros(3), task: 0, what };
        assert_eq!(it.publication().is_some(), publishes, "{what:?}");
    }
    let task = Task { patience: 1, ..task(20, 5, 4, 3) };
    let mut executive = Executive::new([Task { offset: Micros(1), ..task }]).unwrap();
    let mut late = executive;
    while late.simulate(Micros(9), &[Micros(u64::MAX)]).is_some() {}
    // Nothing is acknowledged over the head of what is due.
    assert_eq!((late.watchdog(0), late.wake_at()), (Some(Watchdog::Fault), Some(Micros(21))));
    assert_eq!(late.acknowledge(0, Micros(22)), None);
    let acknowledged = Happening { at: Micros(21), task: 0, what: What::Acknowledged };
    assert_eq!(late.acknowledge(0, Micros(21)), Some(acknowledged));
    for (now, watchdog) in
        [(0, Watchdog::Idle), (1, Watchdog::Run), (6, Watchdog::Extra), (9, Watchdog::Fault)]
    {
        while executive.simulate(Micros(now), &[Micros(u64::MAX)]).is_some() {}
        assert_eq!(executive.watchdog(0), Some(watchdog));
        let is_fault = watchdog == Watchdog::Fault;
        assert_eq!(executive.acknowledge(0, Micros(now)).is_some(), is_fault, "at {now}");
    }
    assert_eq!((executive.watchdog(0), executive.misses(0)), (Some(Watchdog::Idle), Some(0)));
}
