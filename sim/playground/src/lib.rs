//! Supervisors played in a browser: the shipped player behind a narrow door.
//!
//! A page carries a system as [bytes](encode). The module in it, compiled from this crate for
//! WebAssembly, reads them and makes a [`Board`]: what is done goes in, [answers](answer) as
//! numbers come out. The session behind it is that of `cotama simulate`, so the records are too.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`answer`] | records and states as numbers, as a page reads them |
//! | [`Board`] | a run that goes forth and back |
//! | [`Pilot`] | the decider of a robot beside its board |
//! | [`course`] | a mission under a plan of faults, from its start to its end |
//! | [`encode`], [`decode`] | a system as bytes |
//! | [`encode_tables`], [`decode_tables`] | the tables of a decider as bytes |
//! | `write` | the page, with feature `page` |
//! | `outing` | a mission and its faults in a page, with feature `page` |
#![no_std]
#![cfg_attr(kani, allow(clippy::pedantic))]

extern crate alloc;
#[cfg(test)]
extern crate std;

pub mod answer;
mod board;
mod coded;
pub mod course;
#[cfg(feature = "page")]
mod letters;
#[cfg(feature = "page")]
pub mod outing;
#[cfg(feature = "page")]
mod page;
mod pilot;
#[cfg(feature = "page")]
mod robot;
mod tables;

pub use board::{Board, MOST_STEPS, Refused};
pub use coded::{Damaged, decode, encode};
#[cfg(feature = "page")]
pub use page::{Subject, write};
pub use pilot::{Pilot, Seen};
pub use tables::{decode_tables, encode_tables};
