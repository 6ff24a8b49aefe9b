//! Four counters set at once overflow no arithmetic of the compiler.
cotama_core::net! {
    pub mod meter {
        places { Idle: 1 }
        counters { a: 0 of 65_535, b: 0 of 65_535, c: 0 of 65_535, d: 0 of 65_535 }
        events { Clear }
        transitions { clear on Clear: _ => _ read Idle do a = 0 & b = 0 & c = 0 & d = 0; }
    }
}
