//! The robot whose level this is, as the build script prints it from its file and its mission.

#[allow(
    missing_docs,
    nonstandard_style,
    dead_code,
    unreachable_pub,
    clippy::all,
    clippy::pedantic,
    reason = "names are those of the robot's file, of which few are asked for"
)]
mod printed {
    include!(concat!(env!("OUT_DIR"), "/robot.rs"));
}

use cotama_core::player::{self, Checked};
use cotama_models::level::{self, Cause, Level, Tables};
pub use printed::{LEVEL_BYTES, LEVEL_STORED_BYTES, ROBOT, names, system};
use system::SIZE;

/// The tables of the robot.
pub static TABLES: &Tables<'static> = &printed::tables::TABLES;

/// Checks every firing: C's memory may be overwritten by anybody, and what was stored may be any.
///
/// cbindgen:ignore
pub type Program = Checked<system::Program>;

/// The decisional level.
///
/// cbindgen:ignore
pub type Decider =
    level::Decider<'static, Program, { SIZE.words }, { SIZE.clocks }, { SIZE.slots }>;

/// The stored state of its supervisors.
///
/// cbindgen:ignore
pub type Snapshot = player::Snapshot<{ SIZE.words }, { SIZE.clocks }, { SIZE.slots }, Cause>;

const _: () = assert!(Snapshot::BYTES == LEVEL_STORED_BYTES);

/// The level of a robot at rest.
pub fn at_rest() -> Decider {
    Decider::new(Level::start(TABLES, Checked(system::Program)))
}
