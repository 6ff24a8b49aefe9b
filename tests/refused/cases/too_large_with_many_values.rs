//! A counter of its own, far beyond what is explored.
cotama_core::net! {
    pub mod meter {
        places { Idle: 1 }
        counters { seen: 0 of 60_000 }
        events { Tick }
        transitions { tick on Tick: _ => _ read Idle do seen += 1; }
    }
}
