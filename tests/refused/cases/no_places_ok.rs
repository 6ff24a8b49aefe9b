//! A net without a place, which does nothing.
cotama_core::net! {
    /// Nothing.
    pub mod nothing {
        places {}
        transitions {}
    }
}
