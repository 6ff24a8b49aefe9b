//! A crate of a strict user gets no warning from an expansion.
#![deny(missing_docs, unused, nonstandard_style)]
#![forbid(unsafe_code)]
#![warn(clippy::pedantic)]

/// A pose to go to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose(pub i32, pub i32);

cotama_core::net! {
    /// Drives to a pose and retries three times.
    pub mod drive {
        places {
            /// Nothing to do.
            Idle: 1,
            /// Slowly.
            Slow,
            Fast,
            Tickets: 2 of 2,
        }
        flags { lit, /** Whether charged. */ charged: true }
        counters { misses: 0 of 3 }
        shared { camera: true, level: 2 of 2 }
        events {
            /// A pose to go to.
            Goal(Pose),
            Stop,
            Miss,
        }
        outputs { Brake, /// Says it failed.
            Failed }
        groups { Driving: Slow & Fast; }
        transitions {
            /// Starts.
            go   on Goal [charged & camera & level >= 1]: Idle & Tickets => Slow do misses = 0;
            hurry: Slow => Fast within 500..=2_000 ms priority 1;
            stop on Stop: Driving => Idle & Tickets emit Brake;
            miss on Miss [misses < 3]: _ => _ read Driving do misses += 1 & lit = true;
            fail on Miss [misses == 3]: Driving => Idle & Tickets emit Brake & Failed;
            rest: _ => _ read Idle do lit = false after 5_000 ms;
        }
        ignore { Stop in Idle; Goal in Driving; Miss in Idle; }
        laws { never_both(Slow, Fast); invariant(Idle & Slow & Fast = 1); settles; reachable(lit); }
    }
}

mod inner {
    cotama_core::net! {
        mod quiet {
            places { On: 1, Off }
            events { Flip }
            transitions { off on Flip: On => Off; on on Flip: Off => On; }
            laws { handles(all); }
        }
    }

    /// Whether it ends where it began.
    #[must_use]
    pub fn flips() -> bool {
        let mut player = quiet::Player::new();
        let time = cotama_core::units::Millis(0);
        let both = player.offer(time, &quiet::Event::Flip).fired()
            && player.offer(time, &quiet::Event::Flip).fired();
        both && player.state() == quiet::State::On
    }
}

pub use inner::flips;
