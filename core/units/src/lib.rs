//! Physical quantities as integers, and what all rooms of the core share.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`units`] | physical quantities as integers, with checked arithmetic |
//! | [`ticks`] | counters of 32 bits that begin anew, widened to times that do not |
//! | [`memory`] | memory that a caller gives, and its error |
//! | [`checksum`] | whether bytes are still those that were written |
//! | [`text`] | characters of a text that are obeyed or hidden where it is shown |
#![no_std]
#![cfg_attr(any(test, kani), allow(clippy::pedantic))]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(test)]
extern crate std;

pub mod checksum;
pub mod memory;
#[cfg(kani)]
pub mod proofs;
pub mod text;
pub mod ticks;
pub mod units;
