//! A `;` is missing.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go, Stop }
        transitions {
            go on Go: Idle => Driving
            stop on Stop: Driving => Idle;
        }
    }
}
