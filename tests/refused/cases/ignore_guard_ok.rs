//! Guards of `ignore`: of flags, counters, shared places and places, in groups and in extensions.
#![deny(missing_docs, unused, nonstandard_style)]
#![warn(clippy::pedantic)]

/// How full it must be.
pub mod limits {
    /// In thirds.
    pub const LOW: u32 = 1;
}

cotama_core::net! {
    /// Drives when it is charged.
    pub mod drive {
        constants { FULL: 3 }
        places { Idle: 1, Driving, Tokens: 1 of 2 }
        flags { charged: true }
        counters { level: 0 of FULL }
        shared { wifi }
        events { Go, Stop, Empty, Bump }
        groups { Any: Idle & Driving; }
        transitions {
            go    on Go [charged & level < FULL]: Idle => Driving do level += 1;
            stop  on Stop:  Driving => Idle;
            empty on Empty: Driving => Idle do charged = false;
            bump  on Bump [!wifi]: _ => _ read Driving;
        }
        ignore {
            Go in Idle [!charged];
            Go in Idle [level == FULL];
            Go in Driving [Tokens];
            Stop in Idle;
            Empty in Idle & Driving [Idle & !wifi];
            Empty in Idle & wifi [wifi & level <= { FULL }];
            Bump in Any [wifi & Tokens];
            Bump in Idle [!wifi];
        }
        laws { handles(all); deadlock_free_except(Idle); }
    }
}
cotama_core::net! {
    /// The same with a break.
    pub mod wait extends drive {
        places { Waiting }
        events { Rest }
        instead { stop on Stop: Driving => Waiting; }
        transitions { rest on Rest [level >= limits::LOW]: Waiting => Idle; }
        ignore {
            Rest in Any & Waiting [level < limits::LOW];
            Rest in Any [level >= limits::LOW];
            Go in Waiting;
            Stop in Waiting;
            Empty in Waiting [charged];
            Empty in Waiting [!charged];
            Bump in Waiting;
        }
    }
}
