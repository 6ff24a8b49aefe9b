//! The last token is gone.
cotama_core::net! {
    pub mod fuse {
        places { Burns: 1 }
        transitions { burn: Burns => _ after 1_000 ms; }
        laws { deadlock_free; }
    }
}
