//! Sections have names, an order and their own items.
cotama_core::net! {
    pub mod late_events {
        places { Idle: 1, Driving }
        transitions { go on Go: Idle => Driving; }
        events { Go }
    }
}
cotama_core::net! {
    pub mod twice {
        places { Idle: 1, Driving }
        events { Go }
        places { Idle: 1, Driving }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod misspelt {
        places { Idle: 1, Driving }
        event { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod without_places {
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod without_transitions {
        places { Idle: 1, Driving }
        events { Go }
    }
}
cotama_core::net! {
    pub mod laws_first {
        laws { handles(all); }
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod places_by_semicolon {
        places { Idle: 1; Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod events_by_semicolon {
        places { Idle: 1, Driving }
        events { Go; Stop; }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod outputs_by_semicolon {
        places { Idle: 1, Driving }
        events { Go }
        outputs { Beep; }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod equals {
        places { Idle = 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod counter_without_largest {
        places { Idle: 1, Driving }
        counters { tries: 0 }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod counter_without_numbers {
        places { Idle: 1, Driving }
        counters { tries, more: 0 of 2 }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod ignores_two {
        places { Idle: 1, Driving }
        events { Go, Stop }
        transitions { go on Go: Idle => Driving; }
        ignore { Go, Stop in Idle; }
    }
}
cotama_core::net! {
    pub mod ignores_in_two {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
        ignore { Go in Idle, Driving; }
    }
}
cotama_core::net! {
    pub mod ignores_without_end {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
        ignore { Go in Driving }
    }
}
cotama_core::net! {
    pub mod laws_by_comma {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
        laws { handles(all), deadlock_free }
    }
}
cotama_core::net! {
    pub mod law_without_end {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
        laws { reachable(Driving) }
    }
}
