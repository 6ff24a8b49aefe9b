//! A second part arrives before the first one is taken away.
cotama_core::net! {
    /// A belt that brings a part every 300 ms, and a picker that needs 500 ms.
    pub mod belt {
        places { Belt: 1, Tray }
        events { Start }
        transitions {
            bring: Belt => Belt & Tray within 300..=300 ms;
            pick: Tray => _ within 500..=500 ms;
        }
    }
}
