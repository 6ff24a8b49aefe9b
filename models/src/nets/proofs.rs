//! The net of the watchdog and the watchdogs of the executive are the same automaton.

use super::watchdog::{Event, Place, Player, State};
use cotama_core::executive::{Executive, Task, Watchdog, What};
use cotama_core::proofs::few;
use cotama_core::units::{Micros, Millis};

/// From release to release, in milliseconds.
const PERIOD: u64 = 200;

fn ms(it: u64) -> Micros {
    Micros(it * 1_000)
}

/// After any three jobs, in time, late or never done, and with any acknowledgement, the net and the
/// executive are in the same state with the same count of misses.
#[kani::proof]
#[kani::unwind(12)]
pub fn the_net_is_the_watchdog_of_the_executive() {
    let task = Task { deadline: ms(100), extra: ms(20), ..Task::new(ms(PERIOD), ms(100)) };
    let Ok(mut executive) = Executive::new([task]) else { unreachable!() };
    let mut net = Player::new();
    for job in 0..4 {
        let ends = [1, 99, 100, 101, 119, 120, 121, 150][usize::from(few::<3>())];
        let acknowledges = job == 3 && kani::any();
        for (at, what) in [(0, 0), (ends, 1), (160, 2)] {
            let now = PERIOD * job + at;
            // Events due at this instant go first, in both.
            while let Some(it) = executive.step(ms(now)) {
                if matches!(it.what, What::Released | What::Refused) {
                    let _ = net.offer(Millis(now), &Event::Release);
                }
            }
            let _ = net.advance(Millis(now));
            if what == 1 {
                let done = executive.complete(0, ms(now)).is_ok();
                assert!(net.offer(Millis(now), &Event::Done).fired() == done);
            } else if what == 2 && acknowledges {
                let done = executive.acknowledge(0, ms(now)).is_some();
                assert!(net.offer(Millis(now), &Event::CsAck).fired() == done);
            }
            let state = match net.state() {
                State::Idle => Watchdog::Idle,
                State::Run => Watchdog::Run,
                State::Extra => Watchdog::Extra,
                State::Fault => Watchdog::Fault,
            };
            assert!(executive.watchdog(0) == Some(state));
            assert!(executive.misses(0).map(u32::from) == Some(net.tokens(Place::misses)));
        }
        kani::cover!(net.state() == State::Fault, "at fault");
        kani::cover!(acknowledges && net.tokens(Place::misses) == 0, "acknowledged, or in time");
    }
}
