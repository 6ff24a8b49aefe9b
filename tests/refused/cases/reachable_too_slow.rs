//! The other timer is always due first.
cotama_core::net! {
    /// A lamp with two timers.
    pub mod lamp {
        places { Off: 1, Dim, Bright }
        events { Press, Release }
        transitions {
            press on Press: Off => Dim;
            brighten: Dim => Bright within 5..=5 ms;
            fade: Dim => Off within 4..=4 ms;
            release on Release: Bright => Off;
        }
        laws { reachable(Bright); }
    }
}
