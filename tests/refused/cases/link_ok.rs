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

/// Whether a lamp in a function lights.
#[must_use]
pub fn lights() -> bool {
    const ROOM: usize = 1;
    cotama_core::net! {
        mod flash extends lamp { instead { off on toggle: On => Off emit toggled; } }
    }
    cotama_core::system! {
        mod inner {
            nets { button: button, flash: flash }
            links { button.pressed => flash.toggle mail ROOM; }
        }
    }
    let mut player = inner::Player::new();
    let time = cotama_core::units::Millis(0);
    let pressed = player.offer(time, &inner::Event::button(button::Event::press)).fired();
    let _ = player.round(time);
    pressed && inner::state::flash(&player) == flash::State::On
}
