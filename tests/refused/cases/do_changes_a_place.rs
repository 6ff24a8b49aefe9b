//! Tokens are moved, not counted.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => _ do Driving += 1; }
    }
}
