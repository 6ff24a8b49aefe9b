//! The sum is wrong from the beginning; `Holding` counts twice.
cotama_core::net! {
    pub mod gripper {
        places { Empty: 1, Holding }
        events { Grip, Drop }
        transitions {
            grip on Grip: Empty => Holding;
            drop on Drop: Holding => Empty;
        }
        laws { invariant(Empty & Holding * 2 = 2); }
    }
}
