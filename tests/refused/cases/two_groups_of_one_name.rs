//! One name for two groups.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Stop }
        groups { Driving: Slow & Fast; Driving: Slow; }
        transitions { stop on Stop: Driving => Idle; }
    }
}
