//! A token is lost: `drop` gives nothing back.
cotama_core::net! {
    pub mod gripper {
        places { Empty: 1, Holding }
        events { Grip, Drop }
        transitions {
            grip on Grip: Empty => Holding;
            drop on Drop: Holding => _;
        }
        laws { invariant(Empty & Holding = 1); }
    }
}
