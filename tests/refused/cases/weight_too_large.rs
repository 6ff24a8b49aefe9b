//! A weight that no place can have.
cotama_core::net! {
    pub mod rack {
        places { Full: 3 of 3, Empty: 0 of 3 }
        events { Take }
        transitions { take on Take: Full => Empty * 70_000; }
    }
}
