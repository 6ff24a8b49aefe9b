//! The laws of the base are checked for the whole.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go, Stop }
        transitions { go on Go: Idle => Driving; stop on Stop: Driving => Idle; }
        laws { always_can(Idle); }
    }
}
cotama_core::net! {
    pub mod broken extends drive {
        places { Broken }
        transitions { fail on Go: Driving => Broken; }
    }
}
