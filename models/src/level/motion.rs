//! The robot as its supervisors see it: whether it may move.

use cotama_core::net;

net! {
    /// The permit to move: motion is a capability that a running activity holds, and that `halt`
    /// destroys for good. Ours: the papers only say that the robot stops (Durand et al., TAROS
    /// 2010, Section V.C.1).
    pub mod permit {
        places {
            /// No permit: the robot stands, or brakes.
            Withheld: 1,
            /// Commands of motion are obeyed.
            Granted,
            /// There will be no permit any more.
            Destroyed,
        }
        events {
            /// An activity that moves the robot starts.
            grant,
            /// The activity ends.
            revoke,
            /// The mission is given up.
            halt,
        }
        groups { Any: Withheld & Granted; }
        transitions {
            granted on grant: Withheld => Granted;
            revoked on revoke: Granted => Withheld;
            destroyed on halt: Any => Destroyed;
        }
        ignore { grant in Granted & Destroyed; revoke in Withheld & Destroyed; halt in Destroyed; }
        laws {
            invariant(Withheld & Granted & Destroyed = 1);
            always_can(Destroyed);
            reachable(Granted);
            deterministic;
        }
    }
}
