//! A system of two supervisors: the motors run only while the operator is heard.
//!
//! `cargo run` plays it, `cargo test` checks it. Break it and see: with `mail 1` in place of `now`
//! a test fails and shows the way there.
#![no_std]

use cotama_core::{net, system};

net! {
    /// Watches whether the operator is heard.
    pub mod link {
        places { Heard: 1, Silent }
        events { heard }
        outputs { lost }
        transitions {
            still   on heard: Heard => Heard;
            lose: Heard => Silent emit lost within 500..=500 ms;
            recover on heard: Silent => Heard;
        }
        laws { handles(all); deadlock_free; always_can(Heard); }
    }
}

net! {
    /// Lets the motors run.
    pub mod drive {
        places { Stopped: 1, Running }
        shared {
            /// A place of the link, which the drive only reads.
            heard: true,
        }
        events { start, stop, halt }
        outputs { motors_on, motors_off }
        transitions {
            start on start [heard]: Stopped => Running emit motors_on;
            stop  on stop: Running => Stopped emit motors_off;
            halt  on halt: Running => Stopped emit motors_off;
        }
        ignore {
            start in Stopped & Running;
            stop in Stopped;
            halt in Stopped;
        }
        laws { handles(all); deadlock_free_except(Stopped); always_can(Stopped); }
    }
}

system! {
    /// The motors run only while the operator is heard.
    pub mod my_system {
        nets { link: link, drive: drive }
        links { link.lost => drive.halt now; }
        shared { drive.heard = link.Heard; }
    }
}
