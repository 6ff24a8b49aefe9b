//! COTAMA (Durand, Godary-Dejean, Lapierre, Passama, Crestani, TAROS 2010): the decisional level of
//! a Pioneer 3-DX that delivers an object from one office to another.
//!
//! The paper describes the supervisors and shows some of them as figures; the nets here are a
//! reconstruction, and names of places and transitions are ours.
//!
//! Beside the nets stands what they rest on, as data without heap: modules and resources with the
//! closure that says what is [`available`], [`Configuration`]s, the decision as a function
//! ([`decide`]) and the two rules behind it ([`by_rules`]), the FMECA ([`RULES`], [`TEXTS`]) and
//! the diagnosis of flags ([`diagnose`]). Every fact says whether it is stated, inferred or
//! assumed, by its [`Label`] or in its documentation.

mod decider;
mod decisions;
mod dependability;
mod label;
mod level;
mod members;
mod modules;
#[cfg(kani)]
pub mod proofs;
mod requirements;
mod supervisors;

pub use decider::{
    Body, Decider, DeliveryDecider, Finding, Judged, NoPlanLeft, NoPlans, PATIENCE,
    PATIENCE_WITH_PLANNER, Perceived, Plans, Requests, Round, Why, Word,
};
pub use decisions::*;
pub use dependability::*;
pub use label::Label;
pub use level::{Cause, DecisionalLevel, Level, Permit, Return, Told};
pub use modules::*;
pub use requirements::*;
pub use supervisors::*;
