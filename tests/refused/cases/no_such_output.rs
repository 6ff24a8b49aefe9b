//! An output is misspelt.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        outputs { Brake, Horn }
        transitions { go on Go: Idle => Driving emit Break; }
    }
}
