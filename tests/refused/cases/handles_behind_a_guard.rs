//! `Go` is answered only when the battery is charged.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged: true }
        events { Go, Stop, Empty }
        transitions {
            go    on Go [charged]: Idle => Driving;
            stop  on Stop:  Driving => Idle;
            empty on Empty: Driving => Idle do charged = false;
        }
        ignore { Go in Driving; Stop in Idle; Empty in Idle; }
        laws { handles(all); }
    }
}
