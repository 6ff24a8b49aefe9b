//! Eleven lamps have 2,048 states in a system, too.
cotama_core::net! {
    /// Lamps.
    pub mod lamps {
        places { Idle: 1 }
        flags { a, b, c, d, e, f, g, h, i, j, k }
        events { A, B, C, D, E, F, G, H, I, J, K }
        transitions {
            a on A [!a]: _ => _ read Idle do a = true;
            b on B [!b]: _ => _ read Idle do b = true;
            c on C [!c]: _ => _ read Idle do c = true;
            d on D [!d]: _ => _ read Idle do d = true;
            e on E [!e]: _ => _ read Idle do e = true;
            f on F [!f]: _ => _ read Idle do f = true;
            g on G [!g]: _ => _ read Idle do g = true;
            h on H [!h]: _ => _ read Idle do h = true;
            i on I [!i]: _ => _ read Idle do i = true;
            j on J [!j]: _ => _ read Idle do j = true;
            k on K [!k]: _ => _ read Idle do k = true;
        }
        ignore {
            A in a; B in b; C in c; D in d; E in e; F in f;
            G in g; H in h; I in i; J in j; K in k;
        }
        laws { left_to_checker; }
    }
}
cotama_core::system! {
    /// A house.
    pub mod house {
        nets { lamps: lamps }
        laws { handles(all); }
    }
}
