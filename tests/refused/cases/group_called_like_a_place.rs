//! One name for a group and a place.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow, Fast }
        events { Stop }
        groups { Slow: Fast & Idle; }
        transitions { stop on Stop: Slow => Idle; }
    }
}
