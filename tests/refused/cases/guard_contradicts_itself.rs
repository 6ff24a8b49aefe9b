//! The flag cannot be both.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged }
        events { Go }
        transitions { go on Go [charged & !charged]: Idle => Driving; }
    }
}
