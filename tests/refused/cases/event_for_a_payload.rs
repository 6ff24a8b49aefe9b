//! A payload decides nothing, so a guard cannot ask for it.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go(u8) }
        transitions { go on Go(3): Idle => Driving; }
    }
}
