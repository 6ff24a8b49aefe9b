//! The group is misspelt.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Stop }
        groups { Driving: Slow & Fast; }
        transitions { stop on Stop: Drivng => Idle; }
    }
}
