//! The transition waits, and then it can fire.
cotama_core::net! {
    /// A robot that may be sent for a while.
    pub mod errand {
        places { Waiting: 1, Gone }
        events { Go, Back }
        transitions {
            go on Go: Waiting => Gone after 100 ms;
            back on Back: Gone => Waiting;
        }
        ignore { Go in Gone; Back in Waiting; }
        laws { deadlock_free; always_can(Gone); deterministic; }
    }
}
