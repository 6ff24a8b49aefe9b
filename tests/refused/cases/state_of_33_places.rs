//! A state machine of more states than a word has room for.
cotama_core::net! {
    /// A round.
    pub mod round {
        places {
            P0: 1, P1, P2, P3, P4, P5, P6, P7, P8, P9, P10, P11, P12, P13, P14, P15, P16, P17, P18,
            P19, P20, P21, P22, P23, P24, P25, P26, P27, P28, P29, P30, P31, P32
        }
        events { Go }
        transitions {
            t0 on Go: P0 => P1;
            t1 on Go: P1 => P2;
            t2 on Go: P2 => P3;
            t3 on Go: P3 => P4;
            t4 on Go: P4 => P5;
            t5 on Go: P5 => P6;
            t6 on Go: P6 => P7;
            t7 on Go: P7 => P8;
            t8 on Go: P8 => P9;
            t9 on Go: P9 => P10;
            t10 on Go: P10 => P11;
            t11 on Go: P11 => P12;
            t12 on Go: P12 => P13;
            t13 on Go: P13 => P14;
            t14 on Go: P14 => P15;
            t15 on Go: P15 => P16;
            t16 on Go: P16 => P17;
            t17 on Go: P17 => P18;
            t18 on Go: P18 => P19;
            t19 on Go: P19 => P20;
            t20 on Go: P20 => P21;
            t21 on Go: P21 => P22;
            t22 on Go: P22 => P23;
            t23 on Go: P23 => P24;
            t24 on Go: P24 => P25;
            t25 on Go: P25 => P26;
            t26 on Go: P26 => P27;
            t27 on Go: P27 => P28;
            t28 on Go: P28 => P29;
            t29 on Go: P29 => P30;
            t30 on Go: P30 => P31;
            t31 on Go: P31 => P32;
            t32 on Go: P32 => P0;
        }
    }
}

/// Asks for the one marked place.
pub fn now() -> round::State {
    round::Player::new().state()
}
