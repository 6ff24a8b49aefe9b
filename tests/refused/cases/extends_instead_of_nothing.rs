//! There is no such line to replace.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod other extends drive {
        instead { gone on Go: Idle => Driving; }
    }
}
