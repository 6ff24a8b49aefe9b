//! A guard tests one place, not any of several.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast, Dark: 1, Lit }
        events { Go }
        groups { Driving: Slow & Fast; }
        transitions { go on Go [Driving]: Dark => Lit; }
    }
}
