//! One name for a place and a flag.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { Idle }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
