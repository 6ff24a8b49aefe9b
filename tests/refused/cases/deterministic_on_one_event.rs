//! `Go` may mean either.
cotama_core::net! {
    pub mod choice {
        places { Off: 1, Idle, Left, Right }
        events { On, Go }
        transitions {
            on    on On: Off => Idle;
            left  on Go: Idle => Left;
            right on Go: Idle => Right priority 1;
        }
        laws { deterministic; }
    }
}
