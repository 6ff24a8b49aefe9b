//! The model checker: a question, the engines that can answer it, and the choice among them.
//!
//! | module | content |
//! | --- | --- |
//! | [`check`](mod@check) | a question, its answer, and the choice among engines |
//! | [`engines`] | what engines have in common, and all of them |
//! | [`flat`] | a system of nets as one net |
#![cfg_attr(kani, allow(clippy::pedantic))]

pub mod check;
pub mod engines;
pub mod flat;

pub(crate) use engines::components;
#[doc(inline)]
pub use engines::{
    bounds, coverability, explicit, reductions, structural, stubborn, temporal, tpn,
};
