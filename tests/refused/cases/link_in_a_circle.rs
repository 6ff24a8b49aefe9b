//! A rendezvous that comes back.
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
        links { button.pressed => lamp.toggle now; lamp.toggled => button.press now; }
    }
}
