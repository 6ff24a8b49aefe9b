//! The motion of a robot, whoever drives it: on a line, or over a floor.

mod drive;
mod mover;

pub use cotama_models::robots::Motion;
pub use drive::Drive;
pub(crate) use mover::{Ground, Mover, Moves};

use cotama_core::units::Millis;

/// How long the micro-controller waits for a command (Pioneer 3-DX).
pub const FIRMWARE_WATCHDOG: Millis = Millis(2_000);
