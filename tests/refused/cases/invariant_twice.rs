//! One place, named twice.
cotama_core::net! {
    pub mod gripper {
        places { Empty: 1, Holding }
        events { Grip }
        transitions { grip on Grip: Empty => Holding; }
        laws { invariant(Empty & Holding & Empty = 1); }
    }
}
