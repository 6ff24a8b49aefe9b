//! Another net decides whether `Look` is answered.
cotama_core::net! {
    pub mod look {
        places { Idle: 1, Looking }
        shared { camera: true }
        events { Look }
        transitions {
            look on Look [camera]: Idle => Looking;
            back on Look: Looking => Idle;
        }
        laws { handles(all); }
    }
}
