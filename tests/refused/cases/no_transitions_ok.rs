//! Nothing ever happens.
cotama_core::net! {
    /// A stone.
    pub mod stone {
        places { Lies: 1 }
        transitions {}
        laws { invariant(Lies = 1); }
    }
}
