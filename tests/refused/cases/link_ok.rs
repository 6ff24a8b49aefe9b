//! Links of both kinds, and a system with more.
cotama_core::net! {
    /// Says it.
    pub mod button {
        places { Free: 1 }
        events { press }
        outputs { pressed }
        transitions { press on press: Free => Free emit pressed; }
    }
}
cotama_core::net! {
    /// Hears it.
    pub mod lamp {
        places { Off: 1, On }
        events { toggle }
        outputs { toggled }
        transitions { on on toggle: Off => On emit toggled; off on toggle: On => Off; }
    }
}
cotama_core::system! {
    /// A room.
    pub mod room {
        nets { button: button, lamp: lamp }
        links { button.pressed => lamp.toggle mail crate::ROOM; }
    }
}
const ROOM: u8 = 2;

/// Other nets.
pub mod nets {
    cotama_core::net! {
        /// A lamp that can break.
        pub mod bulb extends crate::lamp {
            places { Broken }
            transitions { burn on toggle: On => Broken; }
        }
    }
}
cotama_core::system! {
    /// Two buttons.
    pub mod hall extends room {
        instead { lamp: nets::bulb }
        nets { other: button }
        links { other.pressed => lamp.toggle mail ROOM; }
    }
}
