//! Every part is taken away before the next one arrives.
cotama_core::net! {
    /// A belt that brings a part every 300 ms, and a picker that needs 200 ms.
    pub mod belt {
        places { Belt: 1, Tray }
        events { Start }
        transitions {
            bring: Belt => Belt & Tray within 300..=300 ms;
            pick: Tray => _ within 200..=200 ms;
        }
    }
}
