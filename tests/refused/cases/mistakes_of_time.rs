//! An interval has two ends, in milliseconds.
cotama_core::net! {
    pub mod one_end {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving within 5 ms;
        }
    }
}
cotama_core::net! {
    pub mod half_open {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving within 5..7 ms;
        }
    }
}
cotama_core::net! {
    pub mod seconds {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving within 5..=7 s;
        }
    }
}
cotama_core::net! {
    pub mod no_unit {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving after 5;
        }
    }
}
cotama_core::net! {
    pub mod joined_unit {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving within 5..=7ms priority 1;
        }
    }
}
cotama_core::net! {
    pub mod one_end_of_seconds {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving emit Beep within 5 s;
        }
    }
}
cotama_core::net! {
    pub mod bare {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving within 5;
        }
    }
}
cotama_core::net! {
    pub mod of_a_path {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go: Idle => Driving within times::LONG ms;
        }
    }
}
