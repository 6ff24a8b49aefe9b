//! The section of the events is missing.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go on Go: Idle => Driving; }
    }
}
