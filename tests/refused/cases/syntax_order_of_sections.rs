//! The sections come in their order.
cotama_core::net! {
    pub mod drive {
        events { Go }
        places { Idle: 1, Driving }
        transitions { go on Go: Idle => Driving; }
    }
}
