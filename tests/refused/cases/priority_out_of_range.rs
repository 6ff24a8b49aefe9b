//! A priority that no transition can have.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving priority 40_000; }
    }
}
