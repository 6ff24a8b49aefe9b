//! The loop is entered by an event and a first step of its own.
cotama_core::net! {
    pub mod watch {
        places { Idle: 1, Waking, Looking, Thinking }
        events { Wake }
        transitions {
            wake  on Wake: Idle => Waking;
            stand: Waking => Looking;
            think: Looking => Thinking;
            again: Thinking => Looking;
        }
    }
}
