//! A group names a group.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Stop }
        groups { Driving: Slow & Fast; Any: Driving & Idle; }
        transitions { stop on Stop: Any => Idle; }
    }
}
