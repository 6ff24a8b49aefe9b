//! The counter starts with more than its largest value.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        counters { misses: 4 of 3 }
        events { Go }
        transitions { go on Go: Idle => Driving do misses = 0; }
    }
}
