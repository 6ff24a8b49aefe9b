//! Any of these with any of those is too much for one line.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast, Dark: 1, Lit }
        events { Stop }
        groups { Driving: Slow & Fast; Lamp: Dark & Lit; }
        transitions { stop on Stop: Driving & Lamp => Idle & Dark; }
    }
}
