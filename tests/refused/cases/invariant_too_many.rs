//! The tray takes a second cup while the first one is still there.
cotama_core::net! {
    pub mod tray {
        places { Free: 1, Taken, Clean: 1 }
        events { Put, Lift }
        transitions {
            put  on Put:  Clean => Taken;
            lift on Lift: Taken => Clean;
        }
        laws { invariant(Free & Taken = 1); }
    }
}
