//! A flag is true or false.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged: 2 }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
