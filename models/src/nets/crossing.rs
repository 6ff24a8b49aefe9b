//! A pedestrian crossing with lights and a button.
//!
//! Cars have green until somebody wants to cross, but ten seconds at least; then yellow, red, and a
//! second later the pedestrians walk. Before cars go again, those who are still on the road get
//! four seconds.
//!
//! What to learn from it:
//!
//! - Two lights are two tokens in one net, not one state for each combination: `Red` is only read
//!   when the pedestrians are let go, and both tokens move together where they must, in `go`. That
//!   no car and no pedestrian go at once is then a law and no matter of how the states were written
//!   down.
//! - `request` remembers the button. A press is never lost: only while the pedestrians walk it is
//!   no news.
//! - `Green` and `Yielding` look alike from the road. They are two places since the ten seconds
//!   count from the start of green, and not from the press: a clock runs while *all* that a
//!   transition needs is there, so the request must not be among it.
//! - `warn` needs neither event nor time. Such a transition fires at once, so the net *settles*: it
//!   is never seen with `Yielding` and a request. [`KNOWN`] says how many of them can follow each
//!   other.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::nets::crossing::{Event, Place, Player};
//!
//! let mut lights = Player::new();
//! assert!(lights.offer(Millis(4_000), &Event::Button).fired());
//! assert_eq!(lights.tokens(Place::Green), 1); // cars have their ten seconds
//! let mut turns = [0; 4];
//! let places = [Place::Yellow, Place::Red, Place::Walk, Place::Green];
//! for (turn, place) in turns.iter_mut().zip(places) {
//!     while lights.tokens(place) == 0 {
//!         *turn = lights.wake_at().map_or(0, |at| at.0);
//!         assert!(!lights.advance(Millis(*turn)).behind);
//!     }
//! }
//! assert_eq!(turns, [10_000, 13_000, 14_000, 26_000]);
//! ```

pub use self::crossing::*;

cotama_core::net! {
    /// The lights of a pedestrian crossing with a button.
    mod crossing {
        places {
            /// Cars go, and have not had their ten seconds yet.
            Green: 1,
            /// Cars go, until somebody wants to cross.
            Yielding,
            /// Cars stop if they can.
            Yellow,
            /// Cars stand.
            Red,
            /// Pedestrians stand.
            Stop: 1,
            /// Pedestrians go.
            Walk,
            /// Pedestrians finish, and do not begin.
            Clear,
        }
        flags {
            /// Somebody wants to cross.
            request,
        }
        events {
            /// Somebody presses the button.
            Button,
        }
        outputs {
            /// Lamps of the cars.
            CarsGreen,
            /// Lamps of the cars.
            CarsYellow,
            /// Lamps of the cars.
            CarsRed,
            /// Lamps of the pedestrians.
            PedestriansGreen,
            /// Lamps of the pedestrians.
            PedestriansRed,
        }
        groups { Waiting: Stop & Clear; }
        transitions {
            press on Button [!request]: _ => _ read Waiting do request = true;
            served: Green => Yielding within 10_000..=10_000 ms;
            warn  [request]: Yielding => Yellow emit CarsYellow;
            red:   Yellow => Red emit CarsRed within 3_000..=3_000 ms;
            walk  [request]:
                Stop => Walk read Red do request = false emit PedestriansGreen
                within 1_000..=1_000 ms;
            halt:  Walk => Clear emit PedestriansRed within 8_000..=8_000 ms;
            go:    Clear & Red => Stop & Green emit CarsGreen within 4_000..=4_000 ms;
        }
        ignore { Button in request & Walk; }
        laws {
            invariant(Green & Yielding & Yellow & Red = 1);
            invariant(Stop & Walk & Clear = 1);
            never_both(Walk, Green);
            never_both(Walk, Yielding);
            never_both(Walk, Yellow);
            never_both(Clear, Green);
            never_both(Clear, Yielding);
            never_both(Clear, Yellow);
            never_both(Walk, request);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Walk);
            always_can(Green);
        }
    }
}
