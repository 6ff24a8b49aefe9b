//! A group names a flag.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Slow }
        flags { lit }
        events { Stop }
        groups { Driving: Slow & lit; }
        transitions { stop on Stop: Driving => Idle; }
    }
}
