//! The executive of the core and the nets of its watchdogs do the same, event by event.

use cotama_core::executive::{Executive, Happening, Task, Watchdog, What};
use cotama_core::net;
use cotama_core::player::{Outcome, Why};
use cotama_core::units::{Micros, Millis};
use cotama_models::nets::watchdog;
use proptest::prelude::*;

net! {
    /// The shipped numbers, within a period.
    mod first extends watchdog { constants { DEADLINE: 80 } }
}
net! {
    /// Short and impatient.
    mod second extends watchdog { constants { MISSES: 2, DEADLINE: 30, EXTRA: 10 } }
}
net! {
    /// The extra time outlasts the period, so that a release may be refused, and the first miss is
    /// a fault.
    mod third extends watchdog { constants { MISSES: 1, DEADLINE: 70, EXTRA: 25 } }
}

fn task(period: u64, cost: u64, net: (u64, u64, u8)) -> Task {
    let ms = |ms| Micros::from_millis(Millis(ms)).unwrap();
    let (deadline, extra, patience) = net;
    Task { deadline: ms(deadline), extra: ms(extra), patience, ..Task::new(ms(period), ms(cost)) }
}

fn tasks() -> [Task; 3] {
    [task(100, 12, (80, 20, 3)), task(50, 15, (30, 10, 2)), task(70, 20, (70, 25, 1))]
}

/// The last whole millisecond before an instant: a job is at work in the interval that ends with
/// its end, open there.
fn within(at: Micros) -> Millis {
    Millis(at.0.saturating_sub(1) / 1_000)
}

macro_rules! follow {
    ($name:ident) => {
        /// Tells the net what the executive says has happened; the net does the same, now, and
        /// nothing else.
        fn $name(player: &mut $name::Player, it: Happening, executive: &Executive<3>) {
            use $name::{Event, Firing, Output, Place, State, Transition as T};
            let now = Millis(it.at.0 / 1_000);
            let mut fired = vec![];
            let mut observer =
                |of: &Firing<'_>| fired.push((of.transition(), of.at, of.outputs().collect()));
            match it.what {
                What::Released => {
                    assert!(player.offer_with(now, &Event::Release, &mut observer).fired())
                }
                What::Refused => {
                    let outcome = player.offer_with(now, &Event::Release, &mut observer);
                    assert_eq!(outcome, Outcome::Ignored { why: Why::OnPurpose });
                }
                What::Done | What::DoneLate { .. } => {
                    assert!(player.offer_with(within(it.at), &Event::Done, &mut observer).fired());
                }
                What::DeadlineMissed | What::Skipped { .. } => {
                    assert_eq!(player.wake_at(), Some(now));
                    assert_eq!(player.advance_with(now, &mut observer).fired, 1);
                }
                What::Acknowledged => {
                    assert!(player.offer_with(now, &Event::CsAck, &mut observer).fired())
                }
                What::Exhausted => {}
            }
            let expected = match it.what {
                What::Released => Some((T::w1, now, vec![])),
                What::Done => Some((T::w2, within(it.at).max(player.now()), vec![])),
                What::DeadlineMissed => Some((T::w3, now, vec![])),
                What::DoneLate { rt_fault: false } => Some((T::w4, within(it.at), vec![])),
                What::Skipped { rt_fault: false } => Some((T::w5, now, vec![Output::SkipJob])),
                What::DoneLate { rt_fault: true } => {
                    Some((T::w6, within(it.at), vec![Output::RtFault]))
                }
                What::Skipped { rt_fault: true } => {
                    Some((T::w7, now, vec![Output::SkipJob, Output::RtFault]))
                }
                What::Acknowledged => Some((T::w8, now, vec![])),
                What::Refused | What::Exhausted => None,
            };
            assert_eq!(fired, Vec::from_iter(expected), "{it:?}");
            let watchdog = match player.state() {
                State::Idle => Watchdog::Idle,
                State::Run => Watchdog::Run,
                State::Extra => Watchdog::Extra,
                State::Fault => Watchdog::Fault,
            };
            assert_eq!(executive.watchdog(it.task), Some(watchdog), "{it:?}");
            assert_eq!(
                executive.misses(it.task).map(u32::from),
                Some(player.tokens(Place::misses)),
                "{it:?}"
            );
        }
    };
}

follow!(first);
follow!(second);
follow!(third);

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 10_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn the_executive_and_the_nets_of_its_watchdogs_agree_event_by_event(
        needs in proptest::collection::vec(proptest::array::uniform3(0..40_000_u64), 1..12),
        acknowledge_every in 1..90_u64,
    ) {
        let mut executive = Executive::new(tasks()).unwrap();
        let mut players = (first::Player::new(), second::Player::new(), third::Player::new());
        let mut jobs = [0; 3];
        let mut follow = |it: Happening, executive: &Executive<3>| match it.task {
            0 => first(&mut players.0, it, executive),
            1 => second(&mut players.1, it, executive),
            _ => third(&mut players.2, it, executive),
        };
        for now in (0..800).map(|ms| Micros(ms * 1_000)) {
            let need = |jobs: [usize; 3]| {
                core::array::from_fn(|task| Micros(needs[jobs[task] % needs.len()][task]))
            };
            while let Some(it) = executive.simulate(now, &need(jobs)) {
                follow(it, &executive);
                jobs[it.task] += usize::from(it.what == What::Released);
            }
            for task in (0..3).filter(|_| now.0 / 1_000 % acknowledge_every == 0) {
                if let Some(it) = executive.acknowledge(task, now) {
                    follow(it, &executive);
                }
            }
        }
    }
}
