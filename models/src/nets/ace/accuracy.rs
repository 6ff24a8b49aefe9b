//! Behaviour control: how strictly the active behaviour is checked, and when it has failed.
//!
//! *Print* (algorithm B.1, figures B.5 and B.6): twice a second the next waypoint is checked for
//! consistency, for instance with the direction that a person pointed to. Cycles without success in
//! a row are counted; above MAXTRIALS the goal accuracy falls by one step, and below MINACC the
//! behaviour has failed, so that somebody is asked again.
//!
//! *Reading*: four levels, MINACC = 1, MAXTRIALS = 4; the count starts anew after each fall, else
//! the later levels would last one cycle each; a passed check sets the count back and raises the
//! accuracy by one level (the text says "temporarily").
//!
//! So a goal that stays blocked is reported after exactly 4 levels x (4 + 1) trials = 20 cycles,
//! which is 10 s:
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::nets::ace::accuracy::{Event, Player, State};
//!
//! let mut control = Player::new();
//! assert!(control.offer(Millis(0), &Event::Begin).fired());
//! for cycle in 1..=20 {
//!     assert_ne!(control.state(), State::Failed);
//!     assert!(control.offer(Millis(500 * cycle), &Event::Inconsistent).fired());
//! }
//! assert_eq!(control.state(), State::Failed);
//! ```
//!
//! What to learn from it: a count that is looked at when it is full is a counter with a transition
//! that fires at once (`fall4`, ..., `give_up`): the event only counts. Bounded response is then a
//! property of the token game, to the cycle.

pub use self::ace_accuracy::*;

cotama_core::net! {
    /// ACE's behaviour control: goal accuracy, failed trials, failure.
    mod ace_accuracy {
        places {
            /// The strictest check.
            Accuracy4: 1,
            /// One fall.
            Accuracy3,
            /// Two falls.
            Accuracy2,
            /// The least strict check, MINACC.
            Accuracy1,
            /// The behaviour has failed.
            Failed,
        }
        counters {
            /// Cycles without success in a row, at this accuracy; five are more than MAXTRIALS.
            trials: 0 of 5,
        }
        events {
            /// The next waypoint is consistent.
            Consistent,
            /// The map is not consistent, or there is none.
            Inconsistent,
            /// A behaviour becomes active.
            Begin,
        }
        outputs {
            /// The waypoint goes on to execution.
            Drive,
            /// The behaviour has failed.
            Fail,
        }
        groups { Trying: Accuracy4 & Accuracy3 & Accuracy2 & Accuracy1; }
        transitions {
            miss on Inconsistent: _ => _ read Trying do trials += 1;
            fall4   [trials == 5]: Accuracy4 => Accuracy3 do trials = 0;
            fall3   [trials == 5]: Accuracy3 => Accuracy2 do trials = 0;
            fall2   [trials == 5]: Accuracy2 => Accuracy1 do trials = 0;
            give_up [trials == 5]: Accuracy1 => Failed do trials = 0 emit Fail;

            pass4 on Consistent [trials < 5]: Accuracy4 => Accuracy4 do trials = 0 emit Drive;
            pass3 on Consistent [trials < 5]: Accuracy3 => Accuracy4 do trials = 0 emit Drive;
            pass2 on Consistent [trials < 5]: Accuracy2 => Accuracy3 do trials = 0 emit Drive;
            pass1 on Consistent [trials < 5]: Accuracy1 => Accuracy2 do trials = 0 emit Drive;

            restart on Begin [trials < 5]: Trying => Accuracy4 do trials = 0;
            begin   on Begin: Failed => Accuracy4;
        }
        ignore { Consistent in Failed; Inconsistent in Failed; }
        laws {
            invariant(Accuracy4 & Accuracy3 & Accuracy2 & Accuracy1 & Failed = 1);
            never_both(Failed, trials);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Accuracy4);
            always_can(Accuracy3);
            always_can(Accuracy2);
            always_can(Accuracy1);
            always_can(Failed);
        }
    }
}
