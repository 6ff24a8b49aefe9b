//! The camera of another net may stay off, but it may also come on: what remains is the lost key.
cotama_core::net! {
    pub mod look {
        places { Key: 1, Open, Gone }
        shared { camera }
        events { Look, Lose }
        transitions {
            look on Look [camera]: Key => Open;
            back on Look: Open => Key;
            lose on Lose [!camera]: Key => Gone;
        }
        laws { always_can(Open); }
    }
}
