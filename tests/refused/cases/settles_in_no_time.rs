//! Two intervals that begin at once: it blinks for ever at one instant.
cotama_core::net! {
    /// A lamp that blinks.
    pub mod lamp {
        places { Off: 1, On, Out }
        events { Press }
        transitions {
            press on Press: Off => On;
            out: On => Out within 0..=0 ms;
            back: Out => On within 0..=0 ms;
        }
        laws { always_can(Out); }
    }
}
