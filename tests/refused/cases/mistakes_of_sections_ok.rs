//! Sections have names, an order and their own items.
cotama_core::net! {
    pub mod right {
        places { Idle: 1, Driving }
        counters { tries: 0 of 2 }
        events { Go, Stop }
        outputs { Beep }
        transitions { go on Go: Idle => Driving; }
        ignore { Go in Driving; Stop in Idle & Driving; }
        laws { handles(all); reachable(Driving); }
    }
}
