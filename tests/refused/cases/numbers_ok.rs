//! Constants of all kinds, from all places, and names that the module uses itself.
#![deny(missing_docs, unused, nonstandard_style)]
#![warn(clippy::pedantic)]

/// Timing that the firmware shares.
pub mod timing {
    /// In milliseconds.
    pub const LATE: i32 = 5;
    /// Whether it starts so.
    pub const LIT: bool = true;
}
const SIZE: u8 = 2;
const SOURCE: i64 = -3;

cotama_core::net! {
    /// Drives.
    pub mod drive {
        constants {
            /// Twice as late.
            LATER: 2 * timing::LATE,
        }
        places { Idle: SIZE of { SIZE + 1 }, Driving: 0 of crate::SIZE }
        flags { lit: timing::LIT }
        counters { misses: 0 of SIZE }
        transitions {
            go [misses < SIZE & lit]: Idle * SIZE => Driving * { SIZE }
                do misses += { 1 } within 0..=timing::LATE ms priority SOURCE;
            back: Driving * SIZE => Idle * SIZE after LATER ms;
        }
        laws { invariant(Idle & Driving = SIZE); }
    }
}
