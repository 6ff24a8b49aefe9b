//! The executive: watchdogs, the processor, requests, and what is proven of response times.

use super::*;
use cotama_units::proofs::few;
use cotama_units::units::Micros;

fn us(it: u8) -> Micros {
    Micros(u64::from(it))
}

fn task(period: u8, deadline: u8, cost: u8, extra: u8) -> Task {
    Task { deadline: us(deadline), extra: us(extra), ..Task::new(us(period), us(cost)) }
}

/// A watchdog moves as its net does: released when idle, late at the deadline, idle or at fault
/// after its extra time, and at fault exactly when misses in a row have reached the patience.
#[kani::proof]
#[kani::unwind(9)]
pub fn a_watchdog_moves_as_its_net() {
    const PATIENCE: u8 = 2;
    let only = Task { patience: PATIENCE, ..task(4, 2, 2, 1) };
    let Ok(mut it) = Executive::new([only]) else { unreachable!() };
    let mut now = 0;
    for _ in 0..8 {
        let (before, misses) = (it.watchdog(0), it.misses(0).unwrap_or(0));
        let happening = match few::<2>() {
            0 => it.complete(0, Micros(now)).ok(),
            1 => it.acknowledge(0, Micros(now)),
            jump => {
                now += u64::from(jump) - 1;
                it.step(Micros(now))
            }
        };
        let Some(happening) = happening else {
            assert!(it.watchdog(0) == before && it.misses(0) == Some(misses));
            continue;
        };
        let end = |rt_fault| if rt_fault { Watchdog::Fault } else { Watchdog::Idle };
        let (from, to, counted) = match happening.what {
            What::Released => (Watchdog::Idle, Watchdog::Run, misses),
            What::DeadlineMissed => (Watchdog::Run, Watchdog::Extra, misses + 1),
            What::Done => (Watchdog::Run, Watchdog::Idle, 0),
            What::DoneLate { rt_fault } | What::Skipped { rt_fault } => {
                assert!(rt_fault == (misses == PATIENCE) && rt_fault == happening.rt_fault());
                (Watchdog::Extra, end(rt_fault), misses)
            }
            What::Acknowledged => (Watchdog::Fault, Watchdog::Idle, 0),
            What::Refused | What::Exhausted => {
                assert!(before != Some(Watchdog::Idle));
                let Some(before) = before else { unreachable!() };
                (before, before, misses)
            }
        };
        assert!(before == Some(from) && it.watchdog(0) == Some(to));
        assert!(it.misses(0) == Some(counted) && counted <= PATIENCE);
        assert!(
            happening.at.0 <= now
                && happening.publication().is_some()
                    == matches!(happening.what, What::Done | What::DoneLate { .. })
        );
        kani::cover!(happening.what == What::DoneLate { rt_fault: false }, "late");
        kani::cover!(misses == 1 && to == Watchdog::Extra, "late again");
    }
}

/// The processor is with the most urgent task that is at work and has budget left; no other task
/// uses time, and that one as much as passes.
#[kani::proof]
#[kani::unwind(10)]
pub fn the_most_urgent_has_the_processor() {
    let Ok(mut it) = Executive::new([task(3, 2, 1, 1), task(4, 4, 2, 0)]) else { unreachable!() };
    let mut now = 0;
    for _ in 0..9 {
        let running = it.running();
        let used = [it.used(0), it.used(1)];
        let before = it.now();
        let happening = if kani::any() {
            running.and_then(|task| it.complete(task, Micros(now)).ok())
        } else {
            now += u64::from(few::<1>());
            it.step(Micros(now))
        };
        let passed = it.now().0 - before.0;
        for (task, used) in used.into_iter().enumerate() {
            // A job that began or ended has a count of its own.
            let changed = happening.is_some_and(|it| it.task == task);
            let own = if running == Some(task) { passed } else { 0 };
            let expected = used.map(|it| Micros(it.0 + own));
            assert!(changed || it.used(task) == expected);
        }
        let wants = |task: usize| {
            let (used, budget) = (it.used(task), it.tasks()[task].budget());
            let is_at_work = matches!(it.watchdog(task), Some(Watchdog::Run | Watchdog::Extra));
            assert!(used.is_some() == is_at_work);
            used.is_some_and(|it| it < budget)
        };
        assert!(it.running() == (0..2).find(|&task| wants(task)));
        kani::cover!(
            it.running() == Some(1) && it.used(0).is_some(),
            "the first has no budget left"
        );
    }
}

/// Nothing happens before it is due, and what is due happens when it was, in the order of time:
/// releases in their grid, deadlines after them.
#[kani::proof]
#[kani::unwind(6)]
pub fn due_events_happen_in_order() {
    let (late, jump) = (u64::from(few::<3>()), u64::from(few::<2>()));
    let other = Task { offset: us(few::<2>()), ..task(5, 3, 1, 1) };
    let Ok(mut it) = Executive::new([task(3, 2, 1, 1), other]) else { unreachable!() };
    let mut last = Micros(0);
    for now in [jump, jump + late] {
        for _ in 0..5 {
            let due = it.wake_at();
            let Some(happening) = it.step(Micros(now)) else {
                assert!(due.is_none_or(|due| due.0 > now) && it.now() == Micros(now));
                break;
            };
            assert!(due == Some(happening.at) && happening.at >= last && happening.at.0 <= now);
            last = happening.at;
            // Releases come in their grid, and what belongs to a job after its release.
            let of = it.tasks()[happening.task];
            let after = match happening.what {
                What::Released | What::Refused => 0,
                What::DeadlineMissed => of.deadline.0,
                What::Skipped { .. } => of.deadline.0 + of.extra.0,
                _ => continue,
            };
            assert!((of.period.0 + happening.at.0 - of.offset.0 - after) % of.period.0 == 0);
            kani::cover!(happening.at.0 < now && late > 4, "told late");
        }
        last = it.now();
    }
}

/// The response time of a task that is in time is exactly how long its first job takes when all
/// are released at once; it is late exactly when that is beyond its deadline.
#[kani::proof]
#[kani::unwind(20)]
pub fn response_times_are_those_of_the_critical_instant() {
    let (period, cost) = (2 + few::<3>(), 1 + few::<2>());
    let (long, needs) = (3 + few::<4>(), 1 + few::<3>());
    let deadline = long - few::<1>();
    let tasks = [task(period, period, cost, 0), task(long, deadline, needs, 0)];
    let set = TaskSet::new(&tasks);
    kani::assume(set.is_ok());
    let Ok(set) = set else { unreachable!() };
    // Reference schedule: the more urgent task runs first, one microsecond after the other.
    let (mut urgent, mut left, mut end) = (0, needs, 0);
    for time in 0..deadline {
        if time % period == 0 {
            urgent += cost;
        }
        if urgent > 0 {
            urgent -= 1;
        } else if left > 0 {
            left -= 1;
            end = time + 1;
        }
    }
    let said = set.response_times(Overruns::None).nth(1);
    match said {
        Some(Ok(response)) => assert!(left == 0 && response == us(end)),
        Some(Err(ScheduleError::Late { task, deadline: of, at_least })) => {
            assert!(left > 0 && task == 1 && of == us(deadline) && at_least > of);
        }
        _ => unreachable!(),
    }
    kani::cover!(left == 0 && end == deadline, "just in time");
    kani::cover!(left > 0, "late");
}

/// The most that a task may cost is exact: with it all tasks are in time, and with one microsecond
/// more some task is not, or there is no such cost.
#[kani::proof]
#[kani::unwind(16)]
pub fn the_most_cost_is_exact() {
    let (period, cost) = (2 + few::<2>(), 1 + few::<2>());
    let (long, last) = (3 + few::<3>(), 1 + few::<2>());
    let tasks = [task(period, period, 1, 0), task(long, long, cost, 0), task(12, 11, last, 0)];
    let which = usize::from(few::<2>());
    kani::assume(which < 3);
    let in_time = |cost: u64| {
        let mut changed = tasks;
        changed[which].cost = Micros(cost);
        TaskSet::new(&changed).is_ok_and(|it| it.schedulable(Overruns::None).is_ok())
    };
    let set = TaskSet::new(&tasks);
    kani::assume(set.is_ok());
    match set.map(|it| it.most_cost(which, Overruns::None)) {
        Ok(Ok(Some(most))) => assert!(in_time(most.0) && !in_time(most.0 + 1)),
        Ok(Ok(None)) => assert!(!in_time(1)),
        _ => unreachable!(),
    }
    kani::cover!(in_time(2) && !in_time(3), "two");
    kani::cover!(!in_time(1), "none");
}

/// A task set that is proven to be in time never misses a deadline, with what every job may need.
#[kani::proof]
#[kani::unwind(61)]
pub fn a_task_proven_in_time_is_in_time() {
    let (period, cost) = (2 + few::<2>(), 1 + few::<2>());
    let (long, needs) = (3 + few::<2>(), 1 + few::<3>());
    let tasks = [task(period, period, cost, 0), task(long, long - few::<1>(), needs, 0)];
    let set = TaskSet::new(&tasks);
    kani::assume(set.is_ok());
    let proven = set.is_ok_and(|it| it.schedulable(Overruns::None).is_ok());
    let Ok(mut it) = Executive::new(tasks) else { unreachable!() };
    let (mut missed, costs) = (false, [us(cost), us(needs)]);
    for _ in 0..60 {
        let Some(happening) = it.simulate(Micros(30), &costs) else { break };
        missed |= happening.what == What::DeadlineMissed;
    }
    assert!(missed != proven);
    kani::cover!(proven && needs == 2, "in time");
    kani::cover!(!proven, "late");
}

/// A cost that makes no sense is refused and changes nothing; a kill ends the job and the releases,
/// and what is active again keeps the grid of its releases.
#[kani::proof]
#[kani::unwind(5)]
pub fn requests_take_effect_as_documented() {
    let Ok(mut it) = Executive::new([task(4, 3, 1, 1)]) else { unreachable!() };
    for _ in 0..few::<2>() {
        let next = Micros(it.now().0 + u64::from(few::<1>()));
        let _ = it.step(next);
    }
    kani::assume(it.wake_at().is_none_or(|due| due >= it.now()));
    let (before, now, cost) = (it, it.now(), few::<3>());
    let is_accepted = it.request(0, Request::Cost(us(cost)), now);
    assert!(is_accepted == (1..=4).contains(&cost));
    assert!(it.tasks()[0].cost == if is_accepted { us(cost) } else { us(1) });
    assert!(it.request(0, Request::Kill, now) && it.is_active(0) == Some(false));
    assert!(it.watchdog(0) == Some(Watchdog::Idle) && it.wake_at().is_none());
    let later = Micros(now.0 + u64::from(few::<2>()));
    assert!(it.request(0, Request::Activate, later) && it.is_active(0) == Some(true));
    let next = it.wake_at();
    assert!(next.is_some_and(|it| it >= later && it.0 % 4 == 0 && it.0 < later.0 + 4));
    kani::cover!(before.watchdog(0) == Some(Watchdog::Run) && later > now, "a job is killed");
    kani::cover!(!is_accepted, "refused");
}

/// The last publication is read with its age, and only while it is young enough.
#[kani::proof]
pub fn the_latest_is_read_with_its_age() {
    let (value, at, now, oldest): (u32, u64, u64, u64) =
        (kani::any(), kani::any(), kani::any(), kani::any());
    let mut latest = Latest::empty();
    assert!(latest.read(Micros(now)).is_none());
    latest.publish(Publication { at: Micros(at) }, value);
    let age = now.max(at) - at;
    assert!(latest.read(Micros(now)) == Some((&value, Micros(age))));
    let young = latest.read_within(Micros(now), Micros(oldest));
    assert!(young == if age <= oldest { Some(&value) } else { None });
    kani::cover!(now < at, "told late");
    kani::cover!(young.is_none(), "too old");
}
