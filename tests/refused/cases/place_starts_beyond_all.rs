//! More tokens than any place can hold.
cotama_core::net! {
    pub mod drive {
        places { Idle: 70_000, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
