//! Teams as data: laws of capabilities and bids; instances from files, and their answers.
#![allow(missing_docs)]

#[cfg(feature = "std")]
mod answers;
#[cfg(feature = "std")]
mod at_work;
#[cfg(feature = "std")]
mod broken;
#[cfg(feature = "std")]
mod choices;
#[cfg(feature = "std")]
mod conflicts;
#[cfg(feature = "std")]
mod curves;
#[path = "../../../core/tests/common/draw.rs"]
#[allow(unreachable_pub)]
mod draw;
mod laws;
#[path = "../../../core/assignment/tests/team/tables.rs"]
#[allow(unreachable_pub, dead_code)] // its other half is of the core's tests
mod tables;
#[path = "../../../core/assignment/tests/team/teams.rs"]
#[allow(unreachable_pub)]
mod teams;
#[cfg(feature = "std")]
mod thesis;
