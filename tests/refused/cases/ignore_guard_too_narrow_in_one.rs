//! `Go` is ignored on purpose in `Idle` at a low level only.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged: true }
        counters { level: 0 of 3 }
        events { Go, Stop, Empty }
        transitions {
            go    on Go [charged]: Idle => Driving do level += 1;
            stop  on Stop:  Driving => Idle;
            empty on Empty: Driving => Idle do charged = false;
        }
        ignore { Go in Idle [level < 1]; Go in Driving; Stop in Idle; Empty in Idle; }
        laws { handles(all); }
    }
}
