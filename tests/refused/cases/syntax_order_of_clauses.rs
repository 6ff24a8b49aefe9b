//! `emit` comes before `within`.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        outputs { Beep }
        transitions { go: Idle => Driving within 1..=2 ms emit Beep; }
    }
}
