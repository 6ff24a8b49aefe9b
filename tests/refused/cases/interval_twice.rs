//! Both ways to write an interval at once.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving within 100..=200 ms after 500 ms; }
    }
}
