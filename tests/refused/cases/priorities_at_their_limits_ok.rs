//! The least and the greatest priority.
cotama_core::net! {
    /// A robot that drives.
    pub mod drive {
        places { Idle: 1, Driving }
        transitions {
            go: Idle => Driving priority -32_768;
            stop: Driving => Idle after 1 ms priority 32_767;
        }
    }
}
