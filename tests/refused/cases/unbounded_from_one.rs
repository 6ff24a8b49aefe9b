//! The same where one token is room enough for a bit, and no more.
cotama_core::net! {
    pub mod kitchen {
        places { Open: 1, Order }
        events { Ask }
        transitions { ask on Ask: Open => Open & Order; }
    }
}
