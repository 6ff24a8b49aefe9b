//! Two transitions without event compete for one token.
cotama_core::net! {
    pub mod choice {
        places { Off: 1, Idle, Left, Right }
        events { On }
        transitions {
            on    on On: Off => Idle;
            left:  Idle => Left;
            right: Idle => Right;
        }
        laws { deterministic; }
    }
}
