//! Reads mission files and files of faults.

mod entry;
mod faults;
pub(crate) mod fields;
mod form;
mod ground;
mod limits;
mod mission;
mod moments;
mod options;
mod path;
mod people;
mod recorded;
mod supervision;
mod under;

pub(super) use fields::{Sink, document};
pub(super) use limits::with_limits;
pub(super) use mission::{definition, definition_of};
pub(crate) use recorded::expected;
