//! Two counters cannot be compared.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        counters { misses: 0 of 3, hits: 0 of 3 }
        events { Go }
        transitions { go on Go [misses < hits]: Idle => Driving; }
    }
}
