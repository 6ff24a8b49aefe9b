//! `invariant` lacks its sum.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
        laws { invariant(Idle & Driving); }
    }
}
