//! One name for two places.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving, Idle }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
