//! One name for two events.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go, Go }
        transitions { go on Go: Idle => Driving; }
    }
}
