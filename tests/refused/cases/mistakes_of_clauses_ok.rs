//! Clauses come in their order, and a semicolon ends the line.
cotama_core::net! {
    pub mod right {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving read Ready do tries += 1 emit Beep & Blink within 1..=2 ms
                priority 1;
            stop on Stop: Driving => Idle;
        }
    }
}
