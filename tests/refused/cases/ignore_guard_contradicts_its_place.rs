//! The flag is not false in its own place.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged: true }
        counters { level: 0 of 3 }
        events { Go, Stop, Empty }
        groups { Any: Idle & Driving; }
        transitions {
            go    on Go [charged]: Idle => Driving;
            stop  on Stop:  Driving => Idle;
            empty on Empty: Driving => Idle do charged = false;
        }
        ignore { Go in charged [!charged]; }
    }
}
