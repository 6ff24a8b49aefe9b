//! One robot, whoever drives it: how it moves, fails, computes and is observed.
//!
//! ```text
//! Demand   what the decisional level asks of the motors
//!  -> Robot::answer   failures change it: the decorator of a sound drive
//!  -> Drive::go       position and speed along the path, with the acceleration of the robot
//!  -> Robot::compute  modules under the scheduler, disturbed by failures
//!  -> Robot::observe  flags after their latencies: `Perceived`, all that supervisors see of it
//! ```
//!
//! A mission ([`supervised`](crate::supervised)) and a team ([`fleet`](crate::fleet)) are worlds
//! made of such robots, so a failure means the same in both.

mod chassis;
mod drive;
mod effect;
mod laptop;
mod observing;
mod planted;
mod robot;

pub(crate) use chassis::{Chassis, DELIVERY};
pub use drive::Drive;
pub use effect::{Effect, Ends, FIRMWARE_WATCHDOG, Motion, effect};
pub(crate) use laptop::Seen;
pub(crate) use observing::{Observed, Watch};
pub use planted::Planted;
pub(crate) use robot::{Demand, Failure, Robot};

pub use cotama_models::cotama::{ACCELERATION, PLANNING};

use cotama_core::units::Millis;

/// The period of the control loop, of rounds, and of the steps of the robot (stated: below 0.1 s a
/// loop).
pub const PERIOD: Millis = Millis(100);
