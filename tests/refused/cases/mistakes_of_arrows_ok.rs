//! The arrow is `=>`, between places or `_`.
cotama_core::net! {
    pub mod right {
        places { Idle: 1, Ready: 1, Driving }
        flags { lost }
        counters { tries: 0 of 3 }
        events { Go, Stop }
        outputs { Beep, Blink }
        transitions {
            go on Go [!lost]: Idle & Ready * 1 => Driving emit Beep;
            call on Stop: _ => _ emit Blink;
            go_on on Go: Driving => _;
        }
    }
}
