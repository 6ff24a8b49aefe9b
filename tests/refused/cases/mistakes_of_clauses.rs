//! Clauses come in their order, and a semicolon ends the line.
cotama_core::net! {
    pub mod emits_first {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving emit Beep do tries += 1;
        }
    }
}
cotama_core::net! {
    pub mod emits_twice {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving emit Beep emit Blink;
        }
    }
}
cotama_core::net! {
    pub mod priority_first {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving priority 1 within 1..=2 ms;
        }
    }
}
cotama_core::net! {
    pub mod reads_last {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving do tries += 1 read Ready;
        }
    }
}
cotama_core::net! {
    pub mod unknown {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving output Beep;
        }
    }
}
cotama_core::net! {
    pub mod says_more {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving emit Beep(3);
        }
    }
}
cotama_core::net! {
    pub mod no_semicolon {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving
            stop on Stop: Driving => Idle;
        }
    }
}
cotama_core::net! {
    pub mod no_semicolon_behind_a_clause {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving emit Beep
            stop on Stop: Driving => Idle;
        }
    }
}
cotama_core::net! {
    pub mod no_semicolon_at_the_end {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving
        }
    }
}
