//! Two changes of one counter.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        counters { misses: 0 of 3 }
        events { Go }
        transitions { go on Go: Idle => Driving do misses = 0 & misses += 1; }
    }
}
