//! `ignore` speaks of an event that is not there.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
        ignore { Goes in Driving; }
    }
}
