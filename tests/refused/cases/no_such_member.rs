//! A group names a place that is not there.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Stop }
        groups { Driving: Slow & Fats; }
        transitions { stop on Stop: Driving => Idle; }
    }
}
