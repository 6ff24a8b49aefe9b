//! Half a millisecond cannot be counted.
const HALF: f64 = 0.5;
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving after HALF ms; }
    }
}
