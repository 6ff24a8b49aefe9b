//! The way of the higher priority is always taken.
cotama_core::net! {
    /// A robot that prefers one way.
    pub mod choice {
        places { Fork: 1, Left, Right }
        flags { blocked }
        events { Go, Block, Clear }
        transitions {
            left on Go: Fork => Left priority 1;
            right on Go: Fork => Right priority 2;
            home on Clear: Left => Fork;
            block on Block [!blocked]: _ => _ do blocked = true;
        }
        laws { reachable(Left); reachable(Right); }
    }
}
