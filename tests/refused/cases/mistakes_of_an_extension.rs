//! An extension has the same sections, and `instead` before `transitions`.
cotama_core::net! {
    pub mod lamp {
        places { Off: 1, On }
        events { toggle }
        outputs { lit, hot }
        transitions { on on toggle: Off => On; off on toggle: On => Off; }
    }
}
cotama_core::net! {
    pub mod late_instead extends lamp {
        places { Dim }
        transitions { bright on toggle: Dim => On; }
        instead { on on toggle: Off => Dim; }
    }
}
cotama_core::net! {
    pub mod late_events extends lamp {
        places { Dim }
        transitions { bright on warm: Dim => On; }
        events { warm }
    }
}
cotama_core::net! {
    pub mod emits extends lamp {
        instead { on on toggle: Off => On emit lit, hot; }
    }
}
cotama_core::net! {
    pub mod thin extends lamp {
        places { Dim }
        transitions { bright on toggle: Dim -> On; }
    }
}
