//! A supervisor: it stops the motors when nothing is heard of the operator three times.
//!
//! `cargo run` plays it, `cargo test` checks it. Break it and see: with `lose [missed == 2]` a test
//! fails and shows the way there; without the line of `recover` it does not compile.
#![no_std]

use cotama_core::net;

/// So long the supervisor waits to hear something, in ms.
pub const PATIENCE: u32 = 100;

net! {
    /// Stops the motors when nothing is heard of the operator three times.
    pub mod my_net {
        places {
            /// The motors stand.
            Stopped: 1,
            /// The motors run.
            Running,
            /// The operator was not heard: the motors stand until that changes.
            Lost,
        }
        counters {
            /// How often in a row nothing was heard.
            missed: 0 of 3,
        }
        events { heard, start, stop }
        outputs { motors_on, motors_off }
        transitions {
            start   on start: Stopped => Running emit motors_on;
            stop    on stop:  Running => Stopped do missed = 0 emit motors_off;
            still   on heard: Running => Running do missed = 0;
            miss    [missed < 3]: Running => Running do missed += 1 within PATIENCE..=PATIENCE ms;
            lose    [missed == 3]: Running => Lost emit motors_off;
            recover on heard: Lost => Stopped do missed = 0;
        }
        ignore {
            heard in Stopped;
            start in Running & Lost;
            stop in Stopped & Lost;
        }
        laws {
            handles(all);
            deadlock_free;
            deterministic;
            always_can(Running);
            invariant(Stopped & Running & Lost = 1);
        }
    }
}
