//! Two guests, one chair: `sit` can fire twice.
cotama_core::net! {
    pub mod kitchen {
        places { Guests: 2 of 2, Chair }
        events { Come }
        transitions { sit on Come: Guests => Chair; }
    }
}
