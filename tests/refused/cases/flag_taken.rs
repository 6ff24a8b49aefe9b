//! A flag is no place.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged }
        events { Go }
        transitions { go on Go: Idle & charged => Driving; }
    }
}
