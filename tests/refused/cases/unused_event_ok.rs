//! An event without a transition, and no law that asks for one.
cotama_core::net! {
    /// A fuse.
    pub mod fuse {
        places { Burns: 1, Burnt }
        events { Water }
        transitions { burn: Burns => Burnt after 1_000 ms; }
    }
}
