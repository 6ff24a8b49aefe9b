//! The guard tests more than a transition could touch.
cotama_core::net! {
    pub mod many {
        places { A: 1 }
        flags {
            f0, f1, f2, f3, f4, f5, f6, f7,
            f8, f9, f10, f11, f12, f13, f14, f15,
            f16, f17, f18, f19, f20, f21, f22, f23,
            f24, f25, f26, f27, f28, f29, f30, f31,
        }
        events { E }
        transitions { t on E: A => A; }
        ignore {
            E in A [
                f0 & f1 & f2 & f3 & f4 & f5 & f6 & f7
                & f8 & f9 & f10 & f11 & f12 & f13 & f14 & f15
                & f16 & f17 & f18 & f19 & f20 & f21 & f22 & f23
                & f24 & f25 & f26 & f27 & f28 & f29 & f30 & f31
            ];
        }
    }
}
