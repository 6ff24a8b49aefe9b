//! A place marked in passing is marked.
cotama_core::net! {
    /// A robot that asks, and does not wait for the answer.
    pub mod ask {
        places { Idle: 1, Asking, Told }
        events { Ask, Answer, Thanks, Retry }
        transitions {
            ask on Ask: Idle => Asking;
            give_up: Asking => Idle;
            hear on Answer: Asking => Told;
            thank on Thanks: Told => Idle;
        }
        laws { reachable(Asking); always_can(Asking); deadlock_free; }
    }
}
