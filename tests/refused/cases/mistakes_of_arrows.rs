//! The arrow is `=>`, between places or `_`.
cotama_core::net! {
    pub mod thin {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle -> Driving;
        }
    }
}
cotama_core::net! {
    pub mod weighted {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle & Ready * 1 -> Driving emit Beep;
        }
    }
}
cotama_core::net! {
    pub mod guarded {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go [!lost]: Idle -> Driving;
        }
    }
}
cotama_core::net! {
    pub mod from_nothing {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: => Driving;
        }
    }
}
cotama_core::net! {
    pub mod to_nothing {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Driving => ;
        }
    }
}
