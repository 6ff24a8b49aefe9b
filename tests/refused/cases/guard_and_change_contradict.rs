//! A flag that is false cannot be lowered.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        counters { misses: 0 of 3 }
        events { Go }
        transitions { go on Go [misses == 0]: Idle => Driving do misses -= 1; }
    }
}
