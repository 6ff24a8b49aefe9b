//! Partial order reduction: in each marking only some of the enabled transitions are fired, enough
//! of them to keep the answer.
//!
//! | item | what it answers |
//! | --- | --- |
//! | [`reach_reduced`] | whether a marking with a property is reachable |
//! | [`deadlock`] | whether a marking that enables nothing is reachable |
//!
//! A set of transitions is stubborn (A. Valmari, *Stubborn sets for reduced state space
//! generation*, 1991) when whatever happens outside of it leaves what is in it as it is. Two kinds
//! are used. A goal-oriented set has all transitions that some path to the goal must begin to need,
//! and what they disturb; on each path to the goal its first transition of the set can be fired at
//! once, which leaves a shorter path: nothing is put off for ever. A persistent set has at least
//! one transition that nothing outside can disable; it keeps deadlocks, and with rules for what is
//! seen and for cycles all runs as far as a formula without `X` tells them apart.

mod closure;
mod engine;
mod goal;
mod search;
mod visible;

pub(crate) use closure::Closure;
pub use engine::{Glance, Stubborn};
pub use search::{deadlock, reach_reduced};
pub(crate) use visible::visible;
