//! Robot missions as data: from a mission file to the alternatives of each activity.
//!
//! A file is read by [`Mission::parse`]; a [`Mission`] is its [`Definition`] and the [`Scenario`]
//! that it unfolds to. Beside it stand what may go wrong in a run ([`faults`]), [why there is no
//! plan](infeasible), and the missions that come with the program ([`embedded`]). Without the
//! feature `std` only [`tables`] remain.

pub mod tables;

#[cfg(feature = "std")]
mod axed;
#[cfg(feature = "std")]
mod definition;
#[cfg(feature = "std")]
mod diagnostic;
#[cfg(feature = "std")]
pub mod embedded;
#[cfg(feature = "std")]
pub mod faults;
#[cfg(feature = "std")]
pub mod infeasible;
#[cfg(feature = "std")]
pub mod known;
#[cfg(feature = "std")]
mod lowering;
#[cfg(feature = "std")]
mod mission;
#[cfg(feature = "std")]
mod numbers;
#[cfg(feature = "std")]
mod people;
#[cfg(feature = "std")]
pub(crate) mod reader;
#[cfg(feature = "std")]
mod remaining;
#[cfg(feature = "std")]
mod rust_source;
#[cfg(feature = "std")]
mod scenario;
#[cfg(feature = "std")]
mod supervised;
#[cfg(feature = "std")]
mod terms;
#[cfg(feature = "std")]
mod under;
#[cfg(feature = "std")]
mod upgrade;
#[cfg(feature = "std")]
mod way;

#[cfg(feature = "std")]
pub use definition::{
    AXES, Definition, Does, Hardware, HardwareRequirement, Objective, OwnTask, Robot, Standing,
    Task, Tio, Zone,
};
#[cfg(feature = "std")]
pub use diagnostic::{Diagnostic, MAX_DIAGNOSTICS, MissionErrors, Position, Spanned, told_with};
#[cfg(feature = "std")]
pub use mission::{FORMAT, Mission, Unfolded};
#[cfg(feature = "std")]
pub use numbers::Numbers;
#[cfg(feature = "std")]
pub use people::{People, Walker};
#[cfg(feature = "std")]
pub use remaining::Remaining;
#[cfg(feature = "std")]
pub use scenario::{
    Constraint, Dropped, End, Grows, MAX_ACTIVITIES, MAX_ALTERNATIVES, MAX_ALTERNATIVES_TOTAL,
    PlannedActivity, Scenario, Slowed,
};
#[cfg(feature = "std")]
pub use terms::{MotionPower, PlannedFor, harmless_speed};
#[cfg(feature = "std")]
pub use under::{FORMAT_2, FORMAT_3, Under};
#[cfg(feature = "std")]
pub use upgrade::NotUpgraded;
#[cfg(feature = "std")]
pub use way::{Asked, Leg, NoLeg, Refusal, Way};
