//! Requests of supervisors to the scheduler.

use super::scheduler::{Executive, Watchdog};
use super::task::Task;
use cotama_units::units::Micros;

/// A request of a supervisor about a module (the request and parameter ports of Durand et al.,
/// TAROS 2010, Section II.B).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// The module runs again, from the next release of its grid on.
    Activate,
    /// The module stops once the job under way is over.
    Stop,
    /// The module stops, and the job under way publishes nothing.
    Kill,
    /// The temporal constraint is released: jobs of the module have no deadline and no limit of
    /// processor time, until it is constrained again. The paper names this as the other answer to a
    /// persistent fault (Section VI.A.1). It is for the least urgent module alone, as whatever is
    /// less urgent waits for it.
    Release,
    /// The temporal constraint holds again, from the next job of the module on.
    Constrain,
    /// A parameter changes what its jobs cost, the one under way among them.
    Cost(Micros),
}

impl<const N: usize> Executive<N> {
    /// A supervisor asks something of a module; false, and nothing changes, when the module is not
    /// there, the request makes no sense, or something was due before.
    ///
    /// ```
    /// use cotama_core::executive::{Executive, Request, Task, What};
    /// use cotama_core::units::Micros;
    /// let ms = |ms: u64| Micros(ms * 1_000);
    /// let late = Task { deadline: ms(80), ..Task::new(ms(100), ms(40)) };
    /// let mut executive = Executive::new([late]).unwrap();
    /// // Its jobs take twice as long as they may: released from its constraint, each is done.
    /// assert!(executive.request(0, Request::Release, ms(0)));
    /// let mut done = 0;
    /// while let Some(it) = executive.simulate(ms(999), &[ms(90)]) {
    ///     assert!(matches!(it.what, What::Released | What::Done));
    ///     done += u32::from(it.publication().is_some());
    /// }
    /// assert_eq!(done, 10);
    /// ```
    pub fn request(&mut self, task: usize, request: Request, now: Micros) -> bool {
        if self.wake_at().is_some_and(|due| due < now) {
            return false;
        }
        self.pass(now);
        let now = self.now;
        let (Some(of), Some(module)) = (self.tasks.get_mut(task), self.modules.get_mut(task))
        else {
            return false;
        };
        match request {
            Request::Activate if module.release.is_none() => {
                let passed = now.0.saturating_sub(of.offset.0);
                let periods = passed.div_ceil(of.period.0.max(1));
                let next = periods.checked_mul(of.period.0).map(Micros);
                module.release = next.and_then(|next| next.checked_add(of.offset));
                debug_assert!(
                    module.release.is_none_or(|it| now <= it),
                    "no release is in the past"
                );
            }
            Request::Activate => {}
            Request::Stop => module.release = None,
            Request::Kill => {
                (module.watchdog, module.misses) = (Watchdog::Idle, 0);
                module.release = None;
            }
            Request::Release => module.constrained = false,
            Request::Constrain => module.constrained = true,
            Request::Cost(cost) => {
                let task = Task { cost, ..*of };
                if task.is_senseless() {
                    return false;
                }
                *of = task;
            }
        }
        true
    }

    /// Whether a module is released again; `None` of a task that is not there.
    pub fn is_active(&self, task: usize) -> Option<bool> {
        self.modules.get(task).map(|module| module.release.is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::super::What;
    use super::*;
    use proptest::prelude::*;
    use std::vec::Vec;

    const fn ms(ms: u64) -> Micros {
        Micros(ms * 1_000)
    }

    /// A loop of two modules; the second takes what is left.
    fn executive() -> Executive<2> {
        let task = |cost| Task { deadline: ms(80), extra: ms(20), ..Task::new(ms(100), ms(cost)) };
        Executive::new([task(10), task(50)]).unwrap()
    }

    fn run(it: &mut Executive<2>, until: u64, needs: [u64; 2]) -> Vec<(u64, usize, What)> {
        let mut said = Vec::new();
        while let Some(happening) = it.simulate(ms(until), &needs.map(ms)) {
            said.push((happening.at.0 / 1_000, happening.task, happening.what));
        }
        said
    }

    #[test]
    fn a_stopped_module_ends_its_job_and_a_killed_one_does_not() {
        let mut it = executive();
        run(&mut it, 20, [10, 50]);
        assert!(it.request(1, Request::Stop, ms(20)));
        assert_eq!(run(&mut it, 99, [10, 50]), [(60, 1, What::Done)]);
        assert_eq!(it.is_active(1), Some(false));
        run(&mut it, 105, [10, 50]);
        assert!(it.request(0, Request::Kill, ms(105)));
        assert_eq!(run(&mut it, 500, [10, 50]), []);
    }

    #[test]
    fn a_module_active_again_keeps_the_grid_of_its_releases() {
        let mut it = executive();
        run(&mut it, 150, [10, 50]);
        assert!(it.request(0, Request::Kill, ms(150)) && it.request(1, Request::Kill, ms(150)));
        run(&mut it, 430, [10, 50]);
        assert!(it.request(1, Request::Activate, ms(430)));
        let said = run(&mut it, 560, [10, 50]);
        assert_eq!(said, [(500, 1, What::Released), (550, 1, What::Done)]);
    }

    #[test]
    fn a_module_released_from_its_constraint_takes_the_time_it_needs() {
        let mut it = executive();
        assert!(it.request(1, Request::Release, ms(0)));
        let begun = [(0, 0, What::Released), (0, 1, What::Released), (10, 0, What::Done)];
        // At 82 it has used more than its cost and its extra time.
        assert_eq!(run(&mut it, 82, [10, 75]), begun);
        assert_eq!(run(&mut it, 99, [10, 75]), [(85, 1, What::Done)]);
    }

    #[test]
    fn time_does_not_go_back() {
        let mut it = executive();
        run(&mut it, 20, [10, 50]);
        assert_eq!((it.step(ms(15)), it.now(), it.used(1)), (None, ms(20), Some(ms(10))));
    }

    /// The grid is the offset and every period after it; an instant on it counts.
    #[test]
    fn a_module_active_again_is_released_on_the_grid_of_its_offset() {
        for (now, released) in [(0, 30), (30, 30), (31, 130), (130, 130), (131, 230)] {
            let task = Task { offset: ms(30), ..Task::new(ms(100), ms(10)) };
            let mut it = Executive::new([task]).unwrap();
            assert!(it.request(0, Request::Stop, ms(0)));
            assert_eq!(it.step(ms(now)), None);
            assert!(it.request(0, Request::Activate, ms(now)));
            assert_eq!(it.wake_at(), Some(ms(released)), "at {now} ms");
        }
    }

    #[test]
    fn a_killed_module_has_missed_nothing_when_it_is_active_again() {
        let mut it = executive();
        run(&mut it, 85, [10, 75]);
        assert_eq!(it.misses(1), Some(1));
        assert!(it.request(1, Request::Kill, ms(85)));
        assert_eq!((it.misses(1), it.watchdog(1)), (Some(0), Some(Watchdog::Idle)));
    }

    #[test]
    fn a_parameter_that_costs_less_ends_the_misses() {
        let mut it = executive();
        let late = [10, 75];
        assert!(
            run(&mut it, 299, late)
                .iter()
                .all(|it| !matches!(it.2, What::Skipped { rt_fault: true }))
        );
        let fault = run(&mut it, 300, late);
        assert!(fault.contains(&(300, 1, What::Skipped { rt_fault: true })));
        assert!(it.request(1, Request::Cost(ms(30)), ms(300)));
        assert!(it.acknowledge(1, ms(300)).is_some());
        let after = run(&mut it, 1_000, [10, 30]);
        assert!(after.iter().all(|it| matches!(it.2, What::Released | What::Done)), "{after:?}");
        assert!(!it.request(1, Request::Cost(Micros::ZERO), ms(1_000)));
        assert!(!it.request(2, Request::Stop, ms(1_000)));
    }

    proptest! {
        #[test]
        fn a_module_that_is_not_released_never_misses_and_one_that_is_never_faults(
            needs in prop::collection::vec(1_u64..300, 2),
            asked in prop::collection::vec((0_usize..2, 0_u8..4, 1_u64..40), 0..20),
        ) {
            let mut it = executive();
            let mut now = 0;
            let (mut constrained, mut active) = ([true; 2], [true; 2]);
            for (task, what, wait) in asked {
                let request = [Request::Activate, Request::Kill, Request::Release,
                    Request::Constrain][usize::from(what)];
                prop_assert!(it.request(task, request, ms(now)));
                match request {
                    Request::Activate => active[task] = true,
                    Request::Kill => active[task] = false,
                    // Jobs of before may still be late: they end first.
                    Request::Release => constrained[task] = false,
                    _ => constrained[task] = true,
                }
                prop_assert_eq!(it.is_active(task), Some(active[task]));
                now += 50 * wait;
                let said = run(&mut it, now, [needs[0], needs[1]]);
                for (at, task, what) in said {
                    if at > now.saturating_sub(50 * wait) + 200 {
                        let late = matches!(what, What::DeadlineMissed | What::Skipped { .. });
                        prop_assert!(!late || constrained[task], "{task} at {at}: {what:?}");
                        prop_assert!(active[task] || what == What::Refused, "{task} at {at}");
                    }
                }
            }
        }
    }
}
