//! The watchdog of a real-time scheduler, one for each module that it runs.
//!
//! The control architecture COTAMA (Durand et al., TAROS 2010, Sections IV.B.3 and VI.A.1) watches
//! every periodic module. A job that misses its deadline gets a little extra time, so a transient
//! overrun does no harm; several misses in a row are a fault that is reported to the supervisor,
//! which adapts and acknowledges it. The names `w1` to `w8` are those of its transitions in our
//! reconstruction.
//!
//! | number | value | |
//! | --- | --- | --- |
//! | misses in a row that are a fault | 3 | assumed; the paper says "several" |
//! | deadline after the release: the period | 100 ms | assumed |
//! | extra time after the deadline | 20 ms | assumed |
//!
//! A job that ends within its extra time counts as a miss as well, else a module that is always a
//! little late would never be reported. Only a job done in time sets the count back.
//!
//! What to learn from it:
//!
//! - A counter is a place with a complement: `misses < 3` and `misses == 3` are arcs that read, so
//!   `w4` and `w6` never meet, and `deterministic` can say so.
//! - Deadlines are transitions without event. `w3` is enabled from the release on, so its clock
//!   measures the job; `w5` and `w7` are enabled from the deadline on, so theirs measure the extra
//!   time. All three are due at one instant: time cannot pass it (strong semantics). What is due
//!   fires before an event of the same instant is looked at, so a job that is done at 100 ms sharp
//!   is late: with a clock of 1 ms "before the deadline" cannot be told from "at" it, and the safe
//!   side is to count a miss.
//! - `Release` is ignored while a job runs: the scheduler then moves on to the next module, at most
//!   the extra time late, and this one sits out until its job is over.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::nets::watchdog::{Event, Player, Place, State};
//!
//! let mut watchdog = Player::new();
//! let mut now = 0;
//! for miss in 1..=3 {
//!     assert!(watchdog.offer(Millis(now), &Event::Release).fired());
//!     assert_eq!(watchdog.wake_at(), Some(Millis(now + 100)));
//!     assert!(watchdog.offer(Millis(now + 110), &Event::Done).fired()); // within the extra time
//!     assert_eq!(watchdog.tokens(Place::misses), miss);
//!     now += 200;
//! }
//! assert_eq!(watchdog.state(), State::Fault); // the third in a row
//! assert!(watchdog.offer(Millis(now), &Event::CsAck).fired());
//! assert_eq!(watchdog.tokens(Place::misses), 0);
//! ```
//!
//! Modules differ in their numbers, so a net can extend this one with its own:
//!
//! ```
//! use cotama_core::{net, units::Millis};
//! use cotama_models::nets::watchdog;
//!
//! net! {
//!     /// Two late jobs in a row are a fault.
//!     pub mod impatient extends watchdog { constants { MISSES: 2, DEADLINE: 8, EXTRA: 1 } }
//! }
//!
//! let mut watchdog = impatient::Player::new();
//! for start in [0, 10] {
//!     assert!(watchdog.offer(Millis(start), &impatient::Event::Release).fired());
//!     assert_eq!(watchdog.advance(Millis(start + 9)).fired, 2);
//! }
//! assert_eq!(watchdog.state(), impatient::State::Fault);
//! ```

use cotama_core::net;

pub use self::watchdog::*;

net! {
    /// The scheduler's watchdog for one module: three jobs in a row that miss their deadline are a
    /// fault.
    #[macro_export]
    mod watchdog {
        constants {
            /// Misses in a row that are a fault.
            MISSES: 3,
            /// After the release, in milliseconds.
            DEADLINE: 100,
            /// After the deadline, in milliseconds.
            EXTRA: 20,
        }
        places {
            /// No job of the module runs.
            Idle: 1,
            /// A job runs, and its deadline is ahead.
            Run,
            /// A job runs on in its extra time.
            Extra,
            /// The fault was reported; the module stands still until the supervisor has
            /// reacted.
            Fault,
        }
        counters {
            /// Deadlines missed in a row.
            misses: 0 of MISSES,
        }
        events {
            /// The scheduler starts a job.
            Release,
            /// The job is done.
            Done,
            /// The contextual supervisor has dealt with the fault.
            CsAck,
        }
        outputs {
            /// The job is stopped; what it would have published is not.
            SkipJob,
            /// The module misses its deadlines persistently.
            RtFault,
        }
        transitions {
            w1 on Release: Idle => Run;
            w2 on Done [misses < MISSES]: Run => Idle do misses = 0;
            /// The deadline.
            w3: Run => Extra do misses += 1 within DEADLINE..=DEADLINE ms;
            w4 on Done [misses < MISSES]: Extra => Idle;
            /// The extra time is over.
            w5 [misses < MISSES]: Extra => Idle emit SkipJob within EXTRA..=EXTRA ms;
            w6 on Done [misses == MISSES]: Extra => Fault emit RtFault;
            /// The extra time is over, for the last time in a row.
            w7 [misses == MISSES]: Extra => Fault emit SkipJob & RtFault within EXTRA..=EXTRA ms;
            w8 on CsAck [misses == MISSES]: Fault => Idle do misses = 0;
        }
        ignore {
            Release in Run & Extra & Fault;
            Done in Idle & Fault;
            CsAck in Idle & Run & Extra;
        }
        laws {
            invariant(Idle & Run & Extra & Fault = 1);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Idle);
            always_can(Run);
            always_can(Fault);
        }
    }
}
