//! A disjunction is two lines.
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving }
        flags { charged, plugged }
        events { Go }
        transitions { go on Go [charged | plugged]: Idle => Driving; }
    }
}
