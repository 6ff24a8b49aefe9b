//! Nothing waits, and the light is on.
cotama_core::net! {
    /// Owns the lamp.
    pub mod lamp {
        places { Ready: 1 }
        flags { lit }
        events { press }
        outputs { pressed }
        transitions { press on press: Ready => Ready do lit = true emit pressed; }
        laws { handles(all); }
    }
}
cotama_core::net! {
    /// Counts what happened in the dark.
    pub mod clerk {
        places { Sitting: 1 }
        shared { light, letters: 0 of 2 }
        events { called, letter }
        transitions { note on called [!light]: Sitting => Sitting; }
        ignore {
            called in Sitting [light & letters >= 1];
            letter in Sitting [letters < 2];
            letter in light;
        }
    }
}
cotama_core::system! {
    /// An office.
    pub mod office {
        nets { lamp: lamp, clerk: clerk }
        links { lamp.pressed => clerk.letter mail 2; }
        shared { clerk.light = lamp.lit; }
        pending { clerk.letters = clerk.letter; }
        laws { handles(all); }
    }
}
