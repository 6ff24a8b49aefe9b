//! A system of two nets with a mailbox: `cargo run -p cotama-core --example system`.
//!
//! A camera sees parts on a belt and mails each to an arm, which grips one at a time. Where a part
//! lies travels with the event, and decides nothing. While the mailbox is full, the camera is
//! refused: nothing is lost unseen.

use cotama_core::net::EventId;
use cotama_core::player::{Observer, Outcome};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_core::{net, system};

net! {
    /// Sees parts.
    pub mod camera {
        places { Looking: 1 }
        events { seen }
        outputs { part }
        transitions { see on seen: Looking => Looking emit part; }
        laws { handles(all); deadlock_free; }
    }
}
net! {
    /// Grips a part and puts it down, which takes 250 ms.
    pub mod arm {
        places { Free: 1, Gripping }
        events { part }
        outputs { grip, open }
        transitions {
            begin on part: Free => Gripping emit grip;
            end: Gripping => Free emit open within 250..=250 ms;
        }
        ignore { part in Gripping; }
        laws { handles(all); deadlock_free; always_can(Free); }
    }
}
system! {
    /// A part seen by the camera waits until the turn of the arm.
    pub mod cell {
        nets { camera: camera, arm: arm }
        links { camera.part => arm.part mail 2; }
    }
}

/// Data that events carry along: the position of a part on the belt, mm.
type Cell = cell::Carrying<u16>;
const SEEN: cell::Event = cell::Event::camera(camera::Event::seen);

/// When and where the arm gripped, which parts it let pass, and which the camera could not mail.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Belt {
    pub(crate) gripped: Vec<(Millis, u16)>,
    pub(crate) passed: Vec<u16>,
    pub(crate) refused: Vec<u16>,
}

impl Observer<cell::Program, u16> for Belt {
    fn on_fire(&mut self, firing: &cell::Firing<'_, u16>) {
        if firing.says(cell::Output::arm(arm::Output::grip)) {
            println!("{}: grips at {} mm", firing.at, firing.carries);
            self.gripped.push((firing.at, firing.carries));
        }
    }

    fn on_ignore(&mut self, event: Of<EventId>, place: u16) {
        println!("net {} lets the part at {place} mm pass", event.component);
        self.passed.push(place);
    }
}

/// Runs the program; returns what became of the parts.
pub(crate) fn run() -> Belt {
    let (mut cell, mut belt) = (Cell::new(), Belt::default());
    // When the camera sees a part, and where.
    let mut parts =
        [(20, 100), (120, 180), (130, 190), (140, 200), (420, 90)].into_iter().peekable();
    // One turn of each net every 100 ms, when something waits for it.
    for turn in (100..=700).step_by(100).map(Millis) {
        while let Some((at, place)) = parts.next_if(|it| it.0 < turn.0) {
            match cell.offer_carrying(Millis(at), &SEEN, place, &mut belt) {
                Outcome::Refused { .. } => belt.refused.push(place),
                Outcome::Fired { .. } | Outcome::Ignored { .. } => {}
            }
        }
        if cell.round_is_due() {
            let _ = cell.round_with(turn, &mut belt);
        } else {
            let _ = cell.advance_with(turn, &mut belt);
        }
        println!("{turn}: the arm is {:?}", cell::state::arm(&cell));
    }
    belt
}

fn main() {
    run();
}
