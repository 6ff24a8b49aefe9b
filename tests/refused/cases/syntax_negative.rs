//! Tokens are not negative.
cotama_core::net! {
    pub mod drive {
        places { Idle: -1, Driving }
        transitions { go: Idle => Driving; }
    }
}
