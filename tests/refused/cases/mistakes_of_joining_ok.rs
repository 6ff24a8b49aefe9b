//! Several of a kind are joined by `&`.
cotama_core::net! {
    pub mod right {
        places { Idle: 1, Ready: 1, Driving, Spare: 1 }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle & Ready => Driving read Spare do tries += 1 & lost = true emit Beep &
                Blink;
            stop on Stop: Driving => Idle & Ready;
        }
    }
}
