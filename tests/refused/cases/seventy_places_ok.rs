//! Seventy places fill three words.
cotama_core::net! {
    /// A round.
    pub mod round {
        places {
            P0: 1, P1, P2, P3, P4, P5, P6, P7, P8, P9, P10, P11, P12, P13, P14, P15, P16, P17, P18,
            P19, P20, P21, P22, P23, P24, P25, P26, P27, P28, P29, P30, P31, P32, P33, P34, P35,
            P36, P37, P38, P39, P40, P41, P42, P43, P44, P45, P46, P47, P48, P49, P50, P51, P52,
            P53, P54, P55, P56, P57, P58, P59, P60, P61, P62, P63, P64, P65, P66, P67, P68, P69
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
            t32 on Go: P32 => P33;
            t33 on Go: P33 => P34;
            t34 on Go: P34 => P35;
            t35 on Go: P35 => P36;
            t36 on Go: P36 => P37;
            t37 on Go: P37 => P38;
            t38 on Go: P38 => P39;
            t39 on Go: P39 => P40;
            t40 on Go: P40 => P41;
            t41 on Go: P41 => P42;
            t42 on Go: P42 => P43;
            t43 on Go: P43 => P44;
            t44 on Go: P44 => P45;
            t45 on Go: P45 => P46;
            t46 on Go: P46 => P47;
            t47 on Go: P47 => P48;
            t48 on Go: P48 => P49;
            t49 on Go: P49 => P50;
            t50 on Go: P50 => P51;
            t51 on Go: P51 => P52;
            t52 on Go: P52 => P53;
            t53 on Go: P53 => P54;
            t54 on Go: P54 => P55;
            t55 on Go: P55 => P56;
            t56 on Go: P56 => P57;
            t57 on Go: P57 => P58;
            t58 on Go: P58 => P59;
            t59 on Go: P59 => P60;
            t60 on Go: P60 => P61;
            t61 on Go: P61 => P62;
            t62 on Go: P62 => P63;
            t63 on Go: P63 => P64;
            t64 on Go: P64 => P65;
            t65 on Go: P65 => P66;
            t66 on Go: P66 => P67;
            t67 on Go: P67 => P68;
            t68 on Go: P68 => P69;
            t69 on Go: P69 => P0;
        }
        laws { handles(all); always_can(P0); never_both(P0, P69); deterministic; deadlock_free; }
    }
}
