//! The motion of a robot at mission fidelity, whoever drives it.

mod drive;

pub use cotama_models::robots::Motion;
pub use drive::Drive;

use cotama_core::units::Millis;

/// How long the micro-controller waits for a command (Pioneer 3-DX).
pub const FIRMWARE_WATCHDOG: Millis = Millis(2_000);
