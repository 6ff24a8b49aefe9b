//! The twin: from `Lost` it can be found.
cotama_core::net! {
    /// An errand.
    pub mod errand {
        places { Under: 1, Done, Lost }
        events { Arrive, Silence }
        transitions {
            arrive on Arrive:  Under => Done;
            lose   on Silence: Under => Lost;
            find   on Arrive:  Lost => Under;
        }
        laws { deadlock_free_except(Done); }
    }
}
