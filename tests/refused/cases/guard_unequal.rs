//! `!=` is no comparison of a net.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        counters { misses: 0 of 3 }
        events { Go }
        transitions { go on Go [misses != 2]: Idle => Driving; }
    }
}
