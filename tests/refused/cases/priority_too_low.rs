//! A priority that is one less than the least.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving priority -32_769; }
    }
}
