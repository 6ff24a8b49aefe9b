//! The twin: it says that its laws are left to the model checker.
cotama_core::net! {
    /// Lamps.
    pub mod lamps {
        places { Idle: 1 }
        flags { a, b, c, d, e, f, g, h, i, j, k }
        events { Press }
        transitions {
            a on Press [!a]: _ => _ read Idle do a = true;
            b on Press [!b]: _ => _ read Idle do b = true;
            c on Press [!c]: _ => _ read Idle do c = true;
            d on Press [!d]: _ => _ read Idle do d = true;
            e on Press [!e]: _ => _ read Idle do e = true;
            f on Press [!f]: _ => _ read Idle do f = true;
            g on Press [!g]: _ => _ read Idle do g = true;
            h on Press [!h]: _ => _ read Idle do h = true;
            i on Press [!i]: _ => _ read Idle do i = true;
            j on Press [!j]: _ => _ read Idle do j = true;
            k on Press [!k]: _ => _ read Idle do k = true;
        }
        laws { left_to_checker; }
    }
}
