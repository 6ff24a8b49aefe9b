//! Reads mission files and files of faults.

mod entry;
mod faults;
pub(crate) mod fields;
mod incidents;
mod mission;
mod moments;
mod path;
mod supervision;

pub(super) use fields::{Sink, document};
pub(super) use mission::definition;
