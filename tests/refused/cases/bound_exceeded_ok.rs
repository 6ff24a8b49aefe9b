//! The twin: `sit` waits for a free chair.
cotama_core::net! {
    /// A kitchen.
    pub mod kitchen {
        places { Guests: 2 of 2, Free: 1, Chair }
        events { Come }
        transitions { sit on Come: Guests & Free => Chair; }
    }
}
