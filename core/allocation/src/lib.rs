//! Which sensors and algorithms to use in every part of a mission, so that time, energy and any
//! other additive limit hold.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`problem`] | activities in sequence, candidates with a cost per axis, limits |
//! | [`hardware`] | switchable hardware, counted in units |
//! | [`allocation`] | the trait of the allocators and their answers |
//! | [`panorama`] | the rule of Lambert et al. 2024 |
//! | [`exact`] | the best plan, proven; anytime, with a bound |
//! | [`front`] | all plans that no other plan beats |
//! | [`monitor`] | margins on line, and when to ask for a new plan |
//! | [`hold`] | a reserve for what remains, as past runs have shown it |
#![no_std]
#![cfg_attr(any(test, kani), allow(clippy::pedantic))]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(test)]
extern crate std;

pub mod allocation;
pub mod exact;
pub mod front;
pub mod hardware;
pub mod hold;
pub mod monitor;
mod order;
pub mod panorama;
pub mod problem;
