//! Something is ignored already.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Turning, Driving, Dark: 1, Lit }
        events { Go, Stop, On, Off }
        transitions {
            turn  on Go:   Idle => Turning;
            drive on Go:   Turning => Driving;
            halt  on Stop: Driving => Idle;
            light on On:   Dark => Lit;
            dim   on Off:  Lit => Dark;
        }
        ignore { Go in Driving; }
        laws { handles(all); }
    }
}
