//! Several of a kind are joined by `&`.
cotama_core::net! {
    pub mod emits {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving emit Beep, Blink;
        }
    }
}
cotama_core::net! {
    pub mod takes {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle, Ready => Driving;
        }
    }
}
cotama_core::net! {
    pub mod adds {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle + Ready => Driving;
        }
    }
}
cotama_core::net! {
    pub mod gives {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Driving => Idle, Ready;
        }
    }
}
cotama_core::net! {
    pub mod sums {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Driving => Idle + Ready;
        }
    }
}
cotama_core::net! {
    pub mod reads {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving read Ready, lost;
        }
    }
}
cotama_core::net! {
    pub mod changes {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving do tries += 1, lost = true emit Beep;
        }
    }
}
cotama_core::net! {
    pub mod behind {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            again on Stop: Idle => Idle;
            go on Go: Idle => Driving do tries += 1 emit Beep, Blink;
        }
    }
}
