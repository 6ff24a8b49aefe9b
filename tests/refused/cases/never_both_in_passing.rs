//! While it settles, both are marked.
cotama_core::net! {
    /// An air lock whose doors are sorted out too late.
    pub mod lock {
        places { Shut: 1, Inner, Outer }
        events { Open }
        transitions {
            open on Open: Shut => Inner & Outer;
            shut: Inner & Outer => Shut;
        }
        laws { never_both(Inner, Outer); }
    }
}
