//! A law speaks of a place that is not there.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
        laws { never_both(Idle, Drive); reachable(Drivin); }
    }
}
