//! A flag in a `do` is misspelt.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged: true }
        events { Go }
        transitions { go on Go: Idle => Driving do chargd = false; }
    }
}
