//! When a module that was lost is available again: the hysteresis before the supervisors go up.
//!
//! Durand et al. (TAROS 2010) state how the supervisors degrade and no way back. Where a user asks
//! for one, the supervisors of [`recovering`](crate::cotama::recovering) do not hear of a module
//! that works again before it was sound without a break for a time, and only so many times in a
//! mission; then it is lost for good. So a contact that is loose moves nothing, and whatever fails,
//! modes change a bounded number of times.
//!
//! | number | value | |
//! | --- | --- | --- |
//! | sound without a break | 10 s | assumed: twice the longest latency of a sonar observer |
//! | returns in a mission | 2 | assumed |
//!
//! The net stands before the supervisors, one for each module, as the
//! [watchdog](crate::nets::watchdog) does: it has time, and what hears it is checked with modules
//! that return at any time.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::cotama::recovery::{Event, Player, State};
//!
//! let mut sonar = Player::new();
//! assert!(sonar.offer(Millis(0), &Event::lost).fired());
//! for second in 1..60 {
//!     let says = if second % 2 == 0 { Event::lost } else { Event::sound };
//!     assert!(sonar.offer(Millis(1_000 * second), &says).fired()); // a loose contact
//! }
//! assert_eq!(sonar.state(), State::Settling);
//! assert_eq!(sonar.advance(Millis(68_999)).fired, 0);
//! // 10 s after it was last heard to be sound again
//! assert_eq!(sonar.advance(Millis(69_000)).fired, 1);
//! assert_eq!(sonar.state(), State::Available);
//! ```
//!
//! Modules differ in their numbers, so a net can extend this one with its own:
//!
//! ```
//! use cotama_core::{net, units::Millis};
//! use cotama_models::cotama::recovery;
//!
//! net! {
//!     /// It may return once.
//!     pub mod once extends recovery { constants { HOLD: 500, RETURNS: 1 } }
//! }
//!
//! let mut camera = once::Player::new();
//! assert!(camera.offer(Millis(0), &once::Event::lost).fired());
//! assert!(camera.offer(Millis(100), &once::Event::sound).fired());
//! assert_eq!(camera.advance(Millis(600)).fired, 1);
//! assert!(camera.offer(Millis(700), &once::Event::lost).fired());
//! assert_eq!(camera.state(), once::State::Gone);
//! ```

use cotama_core::net;

pub use self::recovery::*;

net! {
    /// The hysteresis before a module counts as available again: sound for ten seconds without a
    /// break, twice in a mission.
    #[macro_export]
    mod recovery {
        constants {
            /// How long it must be sound without a break, in milliseconds.
            HOLD: 10_000,
            /// How often in a mission it may return.
            RETURNS: 2,
        }
        places {
            /// The module can be used.
            Available: 1,
            /// The module is lost.
            Lost,
            /// The module is sound, and not yet for long enough.
            Settling,
            /// The module is lost for good.
            Gone,
        }
        counters {
            /// How often it may still return.
            returns: RETURNS of RETURNS,
        }
        events {
            /// The observer finds the module faulty.
            lost,
            /// The observer finds the module sound.
            sound,
        }
        outputs {
            /// The module counts as available again.
            restored,
        }
        transitions {
            r1 on lost [returns >= 1]: Available => Lost;
            r2 on lost [returns < 1]: Available => Gone;
            r3 on sound: Lost => Settling;
            r4 on lost: Settling => Lost;
            /// The module was sound for long enough.
            r5: Settling => Available do returns -= 1 emit restored within HOLD..=HOLD ms;
        }
        ignore {
            lost in Lost & Gone;
            sound in Available & Settling & Gone;
        }
        laws {
            invariant(Available & Lost & Settling & Gone = 1);
            handles(all);
            deterministic;
            deadlock_free_except(Gone);
            always_can(Gone);
        }
    }
}
