//! The deterministic core of a robot that must keep its goals: supervisors that are checked before
//! they run, and which sensors and algorithms to use in every part of a mission, so that time,
//! energy and any other additive limit hold.
//!
//! `no_std`, no heap, no floating point, no unsafe code, by default no dependency: the same code
//! plans on a workstation, in a simulator and on a microcontroller, and gives the same plan
//! everywhere. This crate is a face over one for each purpose, and the only one to name.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`units`] | physical quantities as integers, with checked arithmetic |
//! | [`ticks`] | counters of 32 bits that begin anew, widened to times that do not |
//! | [`hardware`] | switchable hardware, counted in units |
//! | [`problem`] | activities in sequence, candidates with a cost per axis, limits |
//! | [`allocation`] | the trait of the allocators and their answers |
//! | [`panorama`] | the rule of Lambert et al. 2024 |
//! | [`exact`] | the best plan, proven; anytime, with a bound |
//! | [`front`] | all plans that no other plan beats |
//! | [`monitor`] | margins on line, and when to ask for a new plan |
//! | [`hold`] | a reserve for what remains, as past runs have shown it |
//! | [`mod@net`] | supervisors as typed Petri nets, checked while compiling |
//! | [`mod@system`] | several nets that work together; a net alone is a system of one |
//! | [`player`] | plays a net or a system: events and time in, what fired out; snapshots |
//! | [`executive`] | periodic modules on one processor, their watchdogs, proofs of response times |
//! | [`team`] | who does what in a team of robots |
//! | [`text`] | characters of a text that are obeyed or hidden where it is shown |
//! | [`guide`] | from an `enum` and a `match` to a checked net, in five minutes |
//!
//! Features, both off by default: `alloc`, for nets that are made at run time on a heap, and
//! workspaces that hold the memory of [`exact`] and [`team::winners`]; `defmt`, so that quantities,
//! outcomes, firings, and what a net names implement `defmt::Format`.
//!
//! Laws of a net speak of what the player does, and are checked while compiling. One
//! [`player::Player`] plays nets and systems. A player of a [`player::Checked`] program takes no
//! law to be proven, and only such a player goes on from a stored marking.
//!
//! Memory comes from the caller, as slices; what it must hold is said where it is asked for. Costs
//! are 32 bits and sums 64 bits wide, so that no sum of a [`problem::Problem`] can overflow.
#![no_std]

#[doc(inline)]
pub use cotama_allocation::{allocation, exact, front, hardware, hold, monitor, panorama, problem};
#[doc(inline)]
pub use cotama_assignment as team;
#[doc(inline)]
pub use cotama_executive as executive;
#[doc(inline)]
pub use cotama_nets::{net, player, system};
#[cfg(kani)]
pub use cotama_units::proofs;
#[doc(inline)]
pub use cotama_units::{checksum, text, ticks, units};

#[doc = include_str!("guide.md")]
pub mod guide {}
