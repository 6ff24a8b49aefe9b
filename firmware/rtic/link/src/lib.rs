//! The supervisor of a radio link, what its board meets, and how that is told: one text, whoever
//! plays it.
#![no_std]
#![forbid(unsafe_code)]

use core::fmt;
use cotama_core::net;
use cotama_core::player::{Firing, Observer, Outcome};
use cotama_core::units::Millis;

/// After so long a silence the robot slows down, ms.
pub const LATE: u32 = 300;
/// So much later it stands, ms.
pub const LOST: u32 = 200;

net! {
    /// Slows the robot down and then stops it while the operator's radio is silent; once it stands,
    /// it goes on only when somebody resets it.
    pub mod link {
        places { Up: 1, Late, Down }
        events {
            /// The radio was heard.
            heard,
            /// The button on the robot.
            reset,
        }
        outputs { full, slow, stop }
        transitions {
            still on heard: Up => Up;
            late: Up => Late emit slow within LATE..=LATE ms;
            again on heard: Late => Up emit full;
            lose: Late => Down emit stop within LOST..=LOST ms;
            recover on reset: Down => Up emit full;
        }
        ignore { heard in Down; reset in Up & Late; }
        laws { handles(all); deterministic; deadlock_free; always_can(Up); always_can(Down); }
    }
}

/// The events of the board, with their times in ms. At 1,200 the radio is heard when the silence is
/// just too long: the due transition fires first.
pub const SCRIPT: [(u32, link::Event); 10] = [
    (100, link::Event::heard),
    (300, link::Event::heard),
    (650, link::Event::heard),
    (900, link::Event::heard),
    (1_200, link::Event::heard),
    (1_800, link::Event::heard),
    (1_850, link::Event::reset),
    (1_900, link::Event::reset),
    (2_000, link::Event::heard),
    (2_100, link::Event::heard),
];
/// When the board is switched off, ms.
pub const END: u32 = 2_900;

/// Writes what fires, and when the player was told the time.
#[derive(Debug)]
pub struct Told<W> {
    /// The destination of the text.
    pub to: W,
    /// The time of the clock.
    pub now: Millis,
}

impl<W: fmt::Write> Observer<link::Program> for Told<W> {
    fn on_fire(&mut self, firing: &Firing<'_, link::Program>) {
        let (at, now) = (firing.at, self.now);
        let _ = write!(self.to, "{at} {:?}", firing.transition());
        for output in firing.outputs() {
            let _ = write!(self.to, " {output:?}");
        }
        let _ = writeln!(self.to, ", told at {now}");
    }
}

impl<W: fmt::Write> Told<W> {
    /// Offers an event, and writes when it is ignored.
    pub fn offer(&mut self, player: &mut link::Player, at: Millis, event: link::Event) {
        if let Outcome::Ignored { why } = player.offer_with(at, &event, self) {
            let _ = writeln!(self.to, "{at} {event:?} is ignored: {why:?}");
        }
    }

    /// Writes where it ends.
    pub fn end(&mut self, player: &link::Player) {
        let _ = writeln!(self.to, "{} the link is {:?}", player.now(), player.state());
    }
}
