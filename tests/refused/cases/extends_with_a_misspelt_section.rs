//! Sections of an extension have the names of those of a net.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        events { Go }
        transitions { go on Go: Idle => Driving; }
    }
}
cotama_core::net! {
    pub mod other extends drive {
        transition { stop on Go: Driving => Idle; }
    }
}
