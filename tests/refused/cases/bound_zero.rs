//! A place that can hold nothing.
cotama_core::net! {
    pub mod rack {
        places { Full: 1, Empty: 0 of 0 }
        events { Take }
        transitions { take on Take: Full => _; }
    }
}
