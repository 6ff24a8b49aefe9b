//! A transition mails two at once into a mailbox of one: it could never fire.
cotama_core::net! {
    /// Says it twice.
    pub mod button {
        places { Free: 1 }
        events { press }
        outputs { pressed, held }
        transitions { press on press: Free => Free emit pressed & held; }
    }
}
cotama_core::net! {
    /// Hears it.
    pub mod lamp {
        places { Off: 1, On }
        events { toggle }
        transitions { on on toggle: Off => On; off on toggle: On => Off; }
    }
}
cotama_core::system! {
    /// A room.
    pub mod room {
        nets { button: button, lamp: lamp }
        links {
            button.pressed => lamp.toggle mail 1;
            button.held => lamp.toggle mail 1;
        }
    }
}
