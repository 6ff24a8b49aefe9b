//! The answers to a subsystem that asks for a behaviour: one such net for each subsystem.
//!
//! *Reading*: in the dissertation a trigger that is refused is not heard of again. Here every
//! trigger is answered (accepted, refused or replaced by a newer one), so the asker knows where it
//! stands.
//!
//! What to learn from it: a handshake is a net of its own. It is small enough to be read, and
//! composed with [`selection`](super::selection) it is checked whether the answer always comes.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::nets::ace::request::{Event, Player, State};
//!
//! let mut vision = Player::new();
//! for (event, then) in [
//!     (Event::Trigger, State::Pending),
//!     (Event::Refused, State::Refused),
//!     (Event::Trigger, State::Pending),
//!     (Event::Accepted, State::Active),
//!     (Event::Ended, State::Silent),
//! ] {
//!     assert!(vision.offer(Millis(0), &event).fired());
//!     assert_eq!(vision.state(), then);
//! }
//! ```

pub use self::ace_request::*;

cotama_core::net! {
    /// One subsystem's request for a behaviour, from ACE.
    mod ace_request {
        places {
            /// The subsystem wants nothing.
            Silent: 1,
            /// The subsystem has asked and was not answered yet.
            Pending,
            /// The behaviour of the subsystem is active.
            Active,
            /// The subsystem was refused, and may ask again.
            Refused,
        }
        events {
            /// The subsystem wants a behaviour.
            Trigger,
            /// The subsystem gets its behaviour.
            Accepted,
            /// Another subsystem is more important.
            Refused,
            /// Another subsystem has taken the robot over.
            Displaced,
            /// The behaviour of the subsystem is completed or has failed.
            Ended,
        }
        outputs {
            /// To the selection.
            Ask,
            /// To the subsystem: the older trigger will not be answered.
            Replaced,
        }
        transitions {
            ask       on Trigger:   Silent => Pending emit Ask;
            ask_again on Trigger:   Refused => Pending emit Ask;
            /// A subsystem may replace its own behaviour.
            change    on Trigger:   Active => Pending emit Ask;
            /// The newest wins.
            replace   on Trigger:   Pending => Pending emit Replaced & Ask;
            accept    on Accepted:  Pending => Active;
            refuse    on Refused:   Pending => Refused;
            displace  on Displaced: Active => Silent;
            end       on Ended:     Active => Silent;
        }
        ignore {
            Accepted in Silent & Active & Refused;
            Refused in Silent & Active & Refused;
            Displaced in Silent & Pending & Refused;
            Ended in Silent & Pending & Refused;
        }
        laws {
            invariant(Silent & Pending & Active & Refused = 1);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Silent);
            always_can(Pending);
            always_can(Active);
            always_can(Refused);
        }
    }
}
