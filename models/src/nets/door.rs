//! An automatic door: the net to begin with.
//!
//! It opens when somebody calls, stays open for five seconds, closes, and never closes on anybody:
//! a light barrier tells whether something stands in the doorway. Any sliding door of an office, a
//! lift or a charging station is one.
//!
//! What to learn from it:
//!
//! - A state machine is a net with one token: [`Place::Closed`] to [`Place::Blocked`] are its
//!   states, and [`Player::state`](cotama_core::player::Player::state) can be matched on.
//! - `obstacle` is a flag: it remembers what an event said, and guards read it. What the door knows
//!   is thus part of the net, and the laws can speak of it: `never_both(Closing, obstacle)` is the
//!   reason why the door may be built.
//! - `close` needs no event: five seconds after it became enabled it fires. Its clock starts anew
//!   when the doorway becomes free, as the guard then enables it, and when `hold` takes the token
//!   of `Open` and gives it back.
//! - `ignore` says where an event is no news. `handles(all)` then shows that nothing was forgotten.
//!
//! Time is told, never asked for: [`wake_at`](cotama_core::player::Player::wake_at) says when the
//! door wants to be woken.
//!
//! ```
//! use cotama_core::{player::Outcome, player::Why, units::Millis};
//! use cotama_models::nets::door::{Event, Player, State, Transition};
//!
//! let mut door = Player::new();
//! let called = Outcome::Fired { transition: Transition::call, settled: 0 };
//! assert_eq!(door.offer(Millis(0), &Event::Call), called);
//! assert!(door.offer(Millis(2_000), &Event::EndOpen).fired());
//! assert_eq!((door.state(), door.wake_at()), (State::Open, Some(Millis(7_000))));
//!
//! // Somebody stands in the doorway from 6 s to 9 s: the five seconds begin again.
//! assert!(door.offer(Millis(6_000), &Event::Obstacle).fired());
//! assert_eq!(door.wake_at(), None);
//! assert!(door.offer(Millis(9_000), &Event::Clear).fired());
//! assert_eq!(door.advance(Millis(14_000)).fired, 1);
//! assert_eq!(door.state(), State::Closing);
//!
//! // Nobody is hit: at once it stands, and it opens when the doorway is free.
//! assert!(door.offer(Millis(14_500), &Event::Obstacle).fired());
//! assert_eq!(door.state(), State::Blocked);
//! assert_eq!(door.offer(Millis(15_000), &Event::Call), Outcome::Ignored { why: Why::OnPurpose });
//! assert!(door.offer(Millis(16_000), &Event::Clear).fired());
//! assert_eq!(door.state(), State::Opening);
//! ```

pub use self::door::*;

cotama_core::net! {
    /// An automatic door that closes by itself and never on anybody.
    mod door {
        places {
            /// Shut, and the motor is off.
            Closed: 1,
            /// The motor opens it.
            Opening,
            /// Wide open, and the motor is off.
            Open,
            /// The motor closes it.
            Closing,
            /// It stands half open until the doorway is free.
            Blocked,
        }
        flags {
            /// Something stands in the doorway.
            obstacle,
        }
        events {
            /// Somebody wants to pass.
            Call,
            /// The switch at the open end.
            EndOpen,
            /// The switch at the closed end.
            EndClosed,
            /// The light barrier is broken.
            Obstacle,
            /// The light barrier is whole again.
            Clear,
        }
        outputs {
            /// Motor, open.
            DriveOpen,
            /// Motor, close.
            DriveClosed,
            /// Motor, stop.
            Stop,
        }
        groups { Harmless: Closed & Opening & Open; }
        transitions {
            call   on Call:      Closed => Opening emit DriveOpen;
            opened on EndOpen:   Opening => Open emit Stop;
            /// A call at an open door gives it the full time again.
            hold   on Call:      Open => Open;
            close  [!obstacle]:  Open => Closing emit DriveClosed within 5_000..=5_000 ms;
            closed on EndClosed: Closing => Closed emit Stop;
            reopen on Call:      Closing => Opening emit DriveOpen;
            block  on Obstacle [!obstacle]: Closing => Blocked do obstacle = true emit Stop;
            free   on Clear [obstacle]:     Blocked => Opening do obstacle = false emit DriveOpen;
            enter  on Obstacle [!obstacle]: _ => _ read Harmless do obstacle = true;
            leave  on Clear [obstacle]:     _ => _ read Harmless do obstacle = false;
        }
        ignore {
            Call in Opening & Blocked;
            EndOpen in Closed & Open & Closing & Blocked;
            EndClosed in Closed & Opening & Open & Blocked;
            Obstacle in obstacle;
            Clear in Closed & Opening & Open & Closing;
        }
        laws {
            invariant(Closed & Opening & Open & Closing & Blocked = 1);
            never_both(Closing, obstacle);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Closed);
            always_can(Open);
            always_can(Blocked);
        }
    }
}
