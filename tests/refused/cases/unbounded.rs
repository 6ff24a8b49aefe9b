//! Every order is taken, none is ever done.
cotama_core::net! {
    pub mod kitchen {
        places { Open: 1, Order: 0 of 2 }
        events { Ask }
        transitions { ask on Ask: Open => Open & Order; }
    }
}
