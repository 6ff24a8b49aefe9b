//! Time is in milliseconds.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving after 2 s; }
    }
}
