//! The twin of the three: nothing is lost or made.
cotama_core::net! {
    /// A gripper.
    pub mod gripper {
        places { Empty: 1, Holding }
        events { Grip, Drop }
        transitions {
            grip on Grip: Empty => Holding;
            drop on Drop: Holding => Empty;
        }
        laws { invariant(Empty & Holding = 1); never_both(Empty, Holding); }
    }
}
