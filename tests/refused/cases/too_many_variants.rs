//! One line for each old value: 60,001 transitions.
cotama_core::net! {
    pub mod meter {
        places { Idle: 1 }
        counters { seen: 0 of 60_000 }
        events { Clear }
        transitions { clear on Clear: _ => _ read Idle do seen = 0; }
    }
}
