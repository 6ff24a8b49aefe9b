//! The interval ends before it begins.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving within 500..=200 ms; }
    }
}
