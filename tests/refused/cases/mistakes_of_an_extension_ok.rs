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
    pub mod right extends lamp {
        places { Dim }
        events { warm }
        instead { on on toggle: Off => Dim emit lit & hot; }
        transitions { bright on warm: Dim => On; }
    }
}
