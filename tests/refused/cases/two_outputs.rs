//! One name for two outputs.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        outputs { Beep, Beep }
        transitions { go on Go: Idle => Driving emit Beep; }
    }
}
