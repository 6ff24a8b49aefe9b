//! Flags alone, and none of them set: `ignore` has no place to name.
cotama_core::net! {
    pub mod lamp {
        places { Spare }
        flags { lit }
        events { Press }
        transitions {
            press on Press [lit]: _ => _ do lit = false;
        }
        laws { handles(all); }
    }
}
