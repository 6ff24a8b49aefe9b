//! One name for two transitions.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions {
            go on Go: Idle => Driving;
            go on Go: Driving => Idle;
        }
    }
}
