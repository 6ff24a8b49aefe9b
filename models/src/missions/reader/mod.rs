//! Reads mission files and files of faults.

mod entry;
mod faults;
pub(crate) mod fields;
mod incidents;
mod limits;
mod mission;
mod moments;
mod path;
mod recorded;
mod supervision;

pub(super) use fields::{Sink, document};
pub(super) use limits::with_limits;
pub(super) use mission::definition;
pub(crate) use recorded::expected;
