//! `Stop` is forgotten three steps away from the start, with a second token about.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Turning, Driving, Docking, Lamp: 1 }
        events { Go, Stop }
        transitions {
            turn  on Go:   Idle => Turning;
            drive on Go:   Turning => Driving;
            dock  on Go:   Driving => Docking;
            done  on Go:   Docking => Idle;
            stop  on Stop: Turning => Idle;
            halt  on Stop: Driving => Idle;
        }
        ignore { Stop in Idle; }
        laws { handles(all); }
    }
}
