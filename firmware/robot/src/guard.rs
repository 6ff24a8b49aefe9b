//! The hardware watchdog is fed by the checked watchdog net: as long as the net stands in no fault.
//!
//! The net is that of COTAMA's scheduler ([`cotama_models::nets::watchdog`]): the control loop is
//! its job. A period that is not over at its deadline is a miss, and three misses in a row are a
//! fault. From then on the hardware watchdog starves, and resets the board.

use cotama_core::net;
use cotama_core::units::Millis;
use cotama_models::nets::watchdog;

/// So long the control loop has for a period before it counts as a miss, in milliseconds.
pub const DEADLINE_MS: u64 = 80;

/// So long the hardware watchdog waits without being fed before it resets the board, in
/// milliseconds: longer than three periods, so that a loop that is late once or twice lives.
pub const STARVES_AFTER_MS: u64 = 500;

net! {
    /// The watchdog of the control loop.
    pub mod loop_watchdog extends watchdog { constants { DEADLINE: 80 } }
}

/// Watches the control loop.
#[derive(Clone, Debug)]
pub struct Guard(loop_watchdog::Player);

impl Default for Guard {
    fn default() -> Self {
        Self(loop_watchdog::Player::new())
    }
}

impl Guard {
    /// A period begins.
    pub fn begin(&mut self, now: Millis) {
        let _ = self.0.offer(now, &loop_watchdog::Event::Release);
    }

    /// A period is over.
    pub fn end(&mut self, now: Millis) {
        let _ = self.0.offer(now, &loop_watchdog::Event::Done);
    }

    /// Whether the hardware watchdog is to be fed now: not when the loop misses its deadlines.
    pub fn feeds(&mut self, now: Millis) -> bool {
        let _ = self.0.advance(now);
        self.0.state() != loop_watchdog::State::Fault
    }
}
