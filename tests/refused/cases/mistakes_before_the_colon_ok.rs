//! A line begins with its name, then `on`, its event and its guard.
cotama_core::net! {
    pub mod right {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go [tries < 3 & !lost]: Idle => Driving;
            alone [lost]: Driving => Idle;
            stop on Stop: Driving => Idle;
        }
    }
}
