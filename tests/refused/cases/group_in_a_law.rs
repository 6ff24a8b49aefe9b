//! A law names one place, not any of several.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Stop }
        groups { Driving: Slow & Fast; }
        transitions { stop on Stop: Driving => Idle; }
        laws { reachable(Driving); }
    }
}
