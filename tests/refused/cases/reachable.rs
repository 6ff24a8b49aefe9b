//! Nothing ever puts a token into `Arrived`.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving, Arrived }
        events { Go, Stop }
        transitions {
            go   on Go:   Idle => Driving;
            stop on Stop: Driving => Idle;
            rest on Stop: Arrived => Idle;
        }
        laws { reachable(Driving); reachable(Arrived); }
    }
}
