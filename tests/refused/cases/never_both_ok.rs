//! The twin: each door reads that the other one is shut.
cotama_core::net! {
    /// A lock.
    pub mod lock {
        places { InnerShut: 1, InnerOpen, OuterShut: 1, OuterOpen }
        events { Inside, Outside }
        transitions {
            open_inner on Inside: InnerShut => InnerOpen read OuterShut;
            open_outer on Outside: OuterShut => OuterOpen read InnerShut;
            shut_inner: InnerOpen => InnerShut after 500 ms;
            shut_outer: OuterOpen => OuterShut after 500 ms;
        }
        laws { never_both(InnerOpen, OuterOpen); }
    }
}
