//! The transition reads, takes nothing and gives nothing.
cotama_core::net! {
    pub mod watch {
        places { Idle: 1 }
        outputs { Beep }
        transitions { beep: _ => _ read Idle emit Beep; }
    }
}
