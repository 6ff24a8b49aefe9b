//! A line begins with its name, then `on`, its event and its guard.
cotama_core::net! {
    pub mod no_on {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go Go [tries < 3]: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod no_on_without_a_guard {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go Go: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod guard_first {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go [tries < 3 & !lost] on Go: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod like_a_match {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go if tries < 3: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod guard_without_event {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go if lost: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod payload {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go(pose): Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod two_by_or {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go | Stop: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod two_by_and {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go & Stop: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod two_by_comma {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go, Stop: Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod no_colon {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod no_colon_behind_a_guard {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go [lost] Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod no_colon_nor_event {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod no_name {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            Idle => Driving;
        }
    }
}
cotama_core::net! {
    pub mod guard_last {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go: Idle => Driving [lost];
        }
    }
}
