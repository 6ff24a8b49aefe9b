//! A flag in a guard is misspelt.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged: true }
        events { Go }
        transitions { go on Go [chraged]: Idle => Driving; }
    }
}
