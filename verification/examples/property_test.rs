//! A property test of a supervisor: `cargo run -p cotama-verification --example property_test`.
//!
//! The blade of a saw runs down for 800 ms after it was stopped. Its cover is unlocked by a timer,
//! which somebody set to 500 ms. Random events at random times find that, and the case is shrunk
//! to the events and the milliseconds that matter.

use cotama_core::net;
use cotama_core::units::Millis;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};
use std::io::{self, Write};

net! {
    /// A saw under a cover.
    pub mod saw {
        constants { UNLOCK: 500 }
        places { Still: 1, Runs, RunsDown, Locked: 1, Waits, Unlocked }
        events { start, stop, shut }
        transitions {
            go on start:  Still => Runs read Locked;
            halt on stop: Runs & Locked => RunsDown & Waits;
            rest: RunsDown => Still within 800..=800 ms;
            unlock: Waits => Unlocked within UNLOCK..=UNLOCK ms;
            lock on shut: Unlocked => Locked;
        }
    }
}
net! {
    /// The same with the timer as it should be.
    pub mod mended extends saw { constants { UNLOCK: 900 } }
}

/// A wait in ms, and the event after it.
type Steps = Vec<(u64, saw::Event)>;

fn steps() -> impl Strategy<Value = Steps> {
    let event =
        prop_oneof![Just(saw::Event::start), Just(saw::Event::stop), Just(saw::Event::shut)];
    vec((0..2_000_u64, event), 0..20)
}

/// Plays the steps; whether the cover was locked whenever the blade moved. Events that the net
/// ignores are part of the game. A macro, as each net has a player of its own type.
macro_rules! is_safe {
    ($net:ident, $steps:expr) => {{
        let (mut saw, mut now) = ($net::Player::new(), 0);
        $steps.iter().all(|&(wait, event)| {
            now += wait;
            let event = match event {
                saw::Event::start => $net::Event::start,
                saw::Event::stop => $net::Event::stop,
                saw::Event::shut => $net::Event::shut,
            };
            let _ = saw.offer(Millis(now), &event);
            let moves = saw.tokens($net::Place::Still) == 0;
            !(moves && saw.tokens($net::Place::Unlocked) == 1)
        })
    }};
}

/// Tests one of the nets with the same random steps each time; the smallest case that breaks it.
fn broken_by(is_safe: impl Fn(&Steps) -> bool) -> Option<Steps> {
    let random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    // In a `#[test]` of `proptest!` the configuration keeps failed cases in a file; not here.
    let config = Config { failure_persistence: None, ..Config::default() };
    let test = |steps: Steps| {
        prop_assert!(is_safe(&steps), "the cover is open and the blade moves");
        Ok(())
    };
    match TestRunner::new_with_rng(config, random).run(&steps(), test) {
        Err(TestError::Fail(_, steps)) => Some(steps),
        Ok(()) | Err(TestError::Abort(_)) => None,
    }
}

/// Runs the program.
pub(crate) fn run(out: &mut impl Write) -> io::Result<()> {
    for (wait, event) in broken_by(|steps| is_safe!(saw, steps)).unwrap_or_default() {
        writeln!(out, "after {wait} ms: {event:?}")?;
    }
    let mended = broken_by(|steps| is_safe!(mended, steps));
    writeln!(out, "mended: {}", mended.map_or("no case found", |_| "broken"))
}

fn main() -> io::Result<()> {
    run(&mut io::stdout())
}
