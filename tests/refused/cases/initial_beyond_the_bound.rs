//! Two tokens in a place of one.
cotama_core::net! {
    pub mod rack {
        places { Full: 2, Empty }
        events { Take }
        transitions { take on Take: Full => Empty; }
    }
}
