//! More than a place can hold.
cotama_core::net! {
    pub mod rack {
        places { Full: 1, Empty: 0 of 65_536 }
        events { Take }
        transitions { take on Take: Full => Empty; }
    }
}
