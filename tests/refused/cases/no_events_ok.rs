//! The net runs by itself, with no law.
cotama_core::net! {
    /// A fuse.
    pub mod fuse {
        places { Burns: 1, Burnt }
        transitions { burn: Burns => Burnt after 1_000 ms; }
    }
}
