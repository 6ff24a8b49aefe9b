//! The twin: guards tell the two apart.
cotama_core::net! {
    /// A choice.
    pub mod choice {
        places { Off: 1, Idle, Left, Right }
        flags { blocked }
        events { On, Block, Go }
        transitions {
            on    on On: Off => Idle;
            block on Block [!blocked]: _ => _ read Idle do blocked = true;
            left  on Go [!blocked]: Idle => Left;
            right on Go [blocked]: Idle => Right;
        }
        laws { deterministic; }
    }
}
