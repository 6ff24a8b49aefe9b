//! Two steps lead to both doors of a lock standing open.
cotama_core::net! {
    pub mod lock {
        places { InnerShut: 1, InnerOpen, OuterShut: 1, OuterOpen }
        events { Inside, Outside }
        transitions {
            open_inner on Inside: InnerShut => InnerOpen;
            open_outer on Outside: OuterShut => OuterOpen;
            shut_inner: InnerOpen => InnerShut after 500 ms;
            shut_outer: OuterOpen => OuterShut after 500 ms;
        }
        laws { never_both(InnerOpen, OuterOpen); }
    }
}
