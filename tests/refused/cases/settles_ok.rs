//! The twin: one step of the round takes time.
cotama_core::net! {
    /// A watch.
    pub mod watch {
        places { Idle: 1, Waking, Looking, Thinking }
        events { Wake }
        transitions {
            wake  on Wake: Idle => Waking;
            stand: Waking => Looking;
            think: Looking => Thinking;
            again: Thinking => Looking within 10..=20 ms;
        }
        laws { settles; }
    }
}
