//! Ready supervisors, to learn from and to use, and families of nets to measure checkers with.
//!
//! Each of the first is a file that reads as a lesson: what it supervises, where it comes from,
//! what to learn from it and how it is played. Its laws were checked while this crate was compiled.
//! They need no heap.
//!
//! | net | lesson |
//! | --- | --- |
//! | [`door`] | states, a flag, a clock: the one to begin with |
//! | [`watchdog`] | a counter, deadlines, strong time |
//! | [`charger`] | groups, a redundant flag that protects, windows for events |
//! | [`crossing`] | two tokens in one net, transitions that fire at once |
//! | [`ace`] | a published robot's behaviour selection and control, as four nets |
//! | [`by_hand`] | COTAMA's supervisors as nets that work together |
//!
//! With the feature `std` there are [`families`] of nets, known from the literature with their
//! counts, and all nets can be [found](find) by name.

pub mod ace;
pub mod by_hand;
pub mod charger;
pub mod crossing;
pub mod door;
#[cfg(kani)]
pub mod proofs;
pub mod watchdog;

#[cfg(feature = "std")]
pub mod families;
#[cfg(feature = "std")]
mod registry;

#[cfg(feature = "std")]
pub use registry::{FindError, Model, ModelEntry, all, find};
