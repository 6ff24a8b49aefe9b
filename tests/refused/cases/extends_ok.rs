//! A net that is another one with more, and one that is that with more.
#![deny(missing_docs, unused, nonstandard_style)]
#![warn(clippy::pedantic)]

/// Bases.
pub mod nets {
    /// A pose to go to.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Pose(pub i32);

    cotama_core::net! {
        /// Drives.
        pub mod drive {
            constants { TIME: 10 }
            places { Idle: 1, Driving }
            events { Go(Pose), Stop }
            groups { Any: Idle & Driving; }
            transitions {
                go on Go: Idle => Driving;
                stop on Stop: Driving => Idle;
                end: Driving => Idle within TIME..=TIME ms;
            }
            laws { always_can(Idle); }
        }
    }
}
pub use nets::Pose;

cotama_core::net! {
    /// Drives and waits.
    pub mod wait extends nets::drive {
        constants { TIME: 20 }
        places { Waiting }
        outputs { Beep }
        instead { stop on Stop: Driving => Waiting emit Beep; }
        transitions { on on Go: Waiting => Driving; }
        ignore { Stop in Waiting; }
        laws { reachable(Waiting); }
    }
}
cotama_core::net! {
    /// Drives and waits, and says so twice.
    pub mod loud extends wait {
        instead {
            stop on Stop: Driving => Waiting emit Beep & Beep;
            on on Go: Waiting => Driving emit Beep;
        }
    }
}
