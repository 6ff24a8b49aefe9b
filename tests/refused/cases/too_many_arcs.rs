//! Forty places in one transition.
cotama_core::net! {
    pub mod many {
        places {
            P0: 1, P1: 1, P2: 1, P3: 1, P4: 1, P5: 1, P6: 1, P7: 1, P8: 1, P9: 1, P10: 1, P11: 1,
            P12: 1, P13: 1, P14: 1, P15: 1, P16: 1, P17: 1, P18: 1, P19: 1, P20: 1, P21: 1, P22: 1,
            P23: 1, P24: 1, P25: 1, P26: 1, P27: 1, P28: 1, P29: 1, P30: 1, P31: 1, P32: 1, P33: 1,
            P34: 1, P35: 1, P36: 1, P37: 1, P38: 1, P39: 1
        }
        events { All }
        transitions {
            all on All: P0 & P1 & P2 & P3 & P4 & P5 & P6 & P7 & P8 & P9 & P10 & P11 & P12 & P13 &
                P14 & P15 & P16 & P17 & P18 & P19 & P20 & P21 & P22 & P23 & P24 & P25 & P26 & P27 &
                P28 & P29 & P30 & P31 & P32 & P33 & P34 & P35 & P36 & P37 & P38 & P39 => _;
        }
    }
}
