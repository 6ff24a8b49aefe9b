//! A net cannot see that a place is empty.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go [!Driving]: Idle => Driving; }
    }
}
