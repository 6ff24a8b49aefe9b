//! A weight of two on a place of one token.
cotama_core::net! {
    pub mod rack {
        places { Full: 1, Empty }
        events { Take }
        transitions { take on Take: Full => Empty * 2; }
    }
}
