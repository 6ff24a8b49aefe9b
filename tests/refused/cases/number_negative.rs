//! A constant that is negative.
const LATE: i32 = -5;
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving within 0..=LATE ms; }
    }
}
