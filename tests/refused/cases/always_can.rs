//! After a fault nothing leads back.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving, Faulty }
        events { Go, Stop, Fault }
        transitions {
            go   on Go:    Idle => Driving;
            stop on Stop:  Driving => Idle;
            fail on Fault: Driving => Faulty;
            note on Stop:  Faulty => Faulty;
        }
        laws { reachable(Faulty); always_can(Idle); }
    }
}
