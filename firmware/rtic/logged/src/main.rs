//! The actions of a supervisor and a system, in defmt's logs: names of events, outputs, states and
//! transitions, which stand in the file of this image and not in its flash.
#![no_std]
#![no_main]

use cortex_m as _; // critical sections
use cortex_m_rt::entry;
use cotama_core::player::Outcome;
use cotama_core::units::Millis;
use cotama_core::{net, system};
use cotama_rtic_link::{END, SCRIPT, link};
use defmt_semihosting as _; // the global logger

net! {
    /// Sounds when it is told to.
    pub mod horn {
        places { Silent: 1, Loud }
        events { sound(u16) }
        outputs { blow }
        transitions {
            sound on sound: Silent => Loud emit blow;
            end: Loud => Silent within 100..=100 ms;
        }
        ignore { sound in Loud; }
        laws { handles(all); deadlock_free; }
    }
}
net! {
    /// Warns who stands before the robot.
    pub mod bumper {
        places { Free: 1 }
        events { touched }
        outputs { warn }
        transitions { touch on touched: Free => Free emit warn; }
        laws { handles(all); deadlock_free; }
    }
}
net! {
    /// Hears the bumper.
    pub mod lamp {
        places { Off: 1, On }
        events { warn }
        outputs { light }
        transitions { on on warn: Off => On emit light; }
        ignore { warn in On; }
        laws { handles(all); }
    }
}
system! {
    /// The bumper and the lamp.
    pub mod warning {
        nets { bumper: bumper, lamp: lamp }
        links { bumper.warn => lamp.warn now; }
    }
}

#[entry]
fn main() -> ! {
    let mut link = link::Player::new();
    let mut log = |firing: &link::Firing<'_>| defmt::info!("{}", firing);
    for (at, event) in SCRIPT {
        let outcome = link.offer_with(Millis(at.into()), &event, &mut log);
        if !outcome.fired() {
            defmt::warn!("{} at {} ms: {}", event, at, outcome);
        }
    }
    let advanced = link.advance_with(Millis(END.into()), &mut log);
    defmt::info!("{} at {}, {}", link.state(), link.now(), advanced);

    // A payload is no part of an event's name.
    let (mut horn, event) = (horn::Player::new(), horn::Event::sound(440));
    if let Outcome::Fired { transition, .. } = horn.offer(Millis(0), &event) {
        defmt::info!("{} on {}, marked {}", transition, event, horn::Place::Loud);
    }

    let mut warning = warning::Player::new();
    let touched = warning::Event::bumper(bumper::Event::touched);
    let mut log = |firing: &warning::Firing<'_>| defmt::info!("{}", firing);
    for at in [10, 20] {
        let outcome = warning.offer_with(Millis(at), &touched, &mut log);
        defmt::info!("{}: {}", touched, outcome);
    }
    semihosting::process::exit(0)
}
