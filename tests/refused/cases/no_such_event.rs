//! An event is misspelt.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go, Stop }
        transitions { go on Goo: Idle => Driving; }
    }
}
