//! To end in `Done` is meant; to end in `Lost` is not.
cotama_core::net! {
    pub mod errand {
        places { Under: 1, Done, Lost }
        events { Arrive, Silence }
        transitions {
            arrive on Arrive:  Under => Done;
            lose   on Silence: Under => Lost;
        }
        laws { deadlock_free_except(Done); }
    }
}
