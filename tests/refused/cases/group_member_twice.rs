//! A group names a place twice.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Stop }
        groups { Driving: Slow & Fast & Slow; }
        transitions { stop on Stop: Driving => Idle; }
    }
}
