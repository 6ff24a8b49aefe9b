//! A token cannot go to any of several places.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Go }
        groups { Driving: Slow & Fast; }
        transitions { go on Go: Idle => Driving; }
    }
}
