//! A constant beyond what a place can hold.
const MANY: u64 = 1 << 40;
cotama_core::net! {
    pub mod drive {
        places { Idle: 1, Driving: 0 of MANY }
        transitions { go: Idle => Driving; }
    }
}
