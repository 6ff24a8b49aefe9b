//! An interval of two months.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        transitions { go: Idle => Driving after 5_184_000_000 ms; }
    }
}
