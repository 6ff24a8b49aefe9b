//! After the seventieth event nothing is answered.
cotama_core::net! {
    pub mod many {
        places { A: 1, B }
        events {
            E0, E1, E2, E3, E4, E5, E6, E7, E8, E9, E10, E11, E12, E13, E14, E15, E16, E17, E18,
            E19, E20, E21, E22, E23, E24, E25, E26, E27, E28, E29, E30, E31, E32, E33, E34, E35,
            E36, E37, E38, E39, E40, E41, E42, E43, E44, E45, E46, E47, E48, E49, E50, E51, E52,
            E53, E54, E55, E56, E57, E58, E59, E60, E61, E62, E63, E64, E65, E66, E67, E68, E69
        }
        transitions {
            t0 on E0: A => A;
            t1 on E1: A => A;
            t2 on E2: A => A;
            t3 on E3: A => A;
            t4 on E4: A => A;
            t5 on E5: A => A;
            t6 on E6: A => A;
            t7 on E7: A => A;
            t8 on E8: A => A;
            t9 on E9: A => A;
            t10 on E10: A => A;
            t11 on E11: A => A;
            t12 on E12: A => A;
            t13 on E13: A => A;
            t14 on E14: A => A;
            t15 on E15: A => A;
            t16 on E16: A => A;
            t17 on E17: A => A;
            t18 on E18: A => A;
            t19 on E19: A => A;
            t20 on E20: A => A;
            t21 on E21: A => A;
            t22 on E22: A => A;
            t23 on E23: A => A;
            t24 on E24: A => A;
            t25 on E25: A => A;
            t26 on E26: A => A;
            t27 on E27: A => A;
            t28 on E28: A => A;
            t29 on E29: A => A;
            t30 on E30: A => A;
            t31 on E31: A => A;
            t32 on E32: A => A;
            t33 on E33: A => A;
            t34 on E34: A => A;
            t35 on E35: A => A;
            t36 on E36: A => A;
            t37 on E37: A => A;
            t38 on E38: A => A;
            t39 on E39: A => A;
            t40 on E40: A => A;
            t41 on E41: A => A;
            t42 on E42: A => A;
            t43 on E43: A => A;
            t44 on E44: A => A;
            t45 on E45: A => A;
            t46 on E46: A => A;
            t47 on E47: A => A;
            t48 on E48: A => A;
            t49 on E49: A => A;
            t50 on E50: A => A;
            t51 on E51: A => A;
            t52 on E52: A => A;
            t53 on E53: A => A;
            t54 on E54: A => A;
            t55 on E55: A => A;
            t56 on E56: A => A;
            t57 on E57: A => A;
            t58 on E58: A => A;
            t59 on E59: A => A;
            t60 on E60: A => A;
            t61 on E61: A => A;
            t62 on E62: A => A;
            t63 on E63: A => A;
            t64 on E64: A => A;
            t65 on E65: A => A;
            t66 on E66: A => A;
            t67 on E67: A => A;
            t68 on E68: A => A;
            last on E69: A => B;
        }
        laws { handles(all); deterministic; }
    }
}
