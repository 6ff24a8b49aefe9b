//! The lamp blinks once in a millisecond.
cotama_core::net! {
    /// A lamp that blinks.
    pub mod lamp {
        places { Off: 1, On, Out }
        events { Press }
        transitions {
            press on Press: Off => On;
            out: On => Out within 0..=0 ms;
            back: Out => On within 1..=1 ms;
        }
        laws { always_can(Out); }
    }
}
