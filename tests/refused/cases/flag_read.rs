//! A flag is tested in a guard.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged }
        events { Go }
        transitions { go on Go: Idle => Driving read charged; }
    }
}
