//! The decisional level of the delivery robot, as its file prints it for a board.
#![no_std]

#[allow(missing_docs, nonstandard_style, reason = "names are those of the robot's file")]
mod printed {
    include!(concat!(env!("OUT_DIR"), "/delivery.rs"));
}

use cotama_core::player::Checked;
use cotama_models::level;
pub use printed::net_p3dx_delivery as system;
pub use printed::tables::TABLES;
pub use printed::{names, tasks};
use system::SIZE;

/// The supervisors, by a program that trusts their marking or checks it.
pub type Level<P> = level::Level<'static, P, { SIZE.words }, { SIZE.clocks }, { SIZE.slots }>;

/// The decisional level, by such a program.
pub type Decider<P> = level::Decider<'static, P, { SIZE.words }, { SIZE.clocks }, { SIZE.slots }>;

/// The program that checks every firing: what was restored is not known to be reachable.
pub type Careful = Checked<system::Program>;

/// The supervisors at rest.
pub fn at_rest<P: cotama_core::player::Program<{ SIZE.words }, { SIZE.clocks }, { SIZE.slots }>>(
    program: P,
) -> Level<P> {
    Level::start(&TABLES, program)
}
