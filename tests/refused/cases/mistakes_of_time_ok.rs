//! An interval has two ends, in milliseconds.
cotama_core::net! {
    pub mod right {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving emit Beep within 5..=7 ms priority 1;
            stop: Driving => Idle after 5 ms;
        }
    }
}
