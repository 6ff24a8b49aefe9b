//! Teams of robots as data: what each robot can do and how reliably, what tasks need, what a robot
//! bids, and what an error means (F. Rohrmueller, *Cooperative Action Selection*, dissertation, TU
//! München 2011, ch. 3).
//!
//! [`Robot`]s have [`Capability`]s, each with a [`Reliability`]. A [`Constraint`] says which
//! capabilities an [`Action`] needs: all of some, any of some, nested; there is no "not", so more
//! capabilities never make a robot less capable. An [`ActionPlan`] is a sequence of actions, and a
//! [`Role`] has alternative action plans. A whole team with its tasks, their plans and utilities is
//! a `scenario` (feature `std`), of which the rest is made.
//!
//! What follows from these: [`mutual_heterogeneity`] and [`team_heterogeneity`], whether a
//! coalition [is capable](capable), the [`failure_aware_cost`] that a robot bids, the [`Pledge`] of
//! the winner, and the [`ErrorClass`] of what goes wrong. [`service`] is the thesis's drink
//! service; `protocol` (feature `std`) is how robots agree on who does what, as nets. [`thesis`]
//! has the thesis's own methods, with which answers are compared; `curves` (feature `std`) says how
//! they grow with the team.
//!
//! No floating point, no heap: probabilities are counted in parts per 10⁹ and rounded down, costs
//! are integers and rounded up, so that no robot promises more than it can hold.

mod bid;
mod capability;
mod constraint;
#[cfg(feature = "std")]
pub mod curves;
mod error_class;
mod heterogeneity;
#[cfg(feature = "std")]
pub mod instance;
#[cfg(kani)]
pub mod proofs;
#[cfg(feature = "std")]
pub mod protocol;
mod pruning;
mod ratio;
mod reliability;
#[cfg(feature = "std")]
pub mod scenario;
pub mod service;
mod task;
pub mod thesis;

pub use bid::{Bid, MAX_STEPS, Pledge, Step, failure_aware_cost, failure_cost, steps};
pub use capability::{Capability, CapabilitySet, Robot, Skill};
pub use constraint::{Alternatives, Constraint, Used};
pub use error_class::{ErrorClass, MOST_REPEATS, classify};
pub use heterogeneity::{mutual_heterogeneity, team_heterogeneity};
pub use pruning::{Capable, MAX_PRUNED, capable};
pub use ratio::Ratio;
pub use reliability::{Probability, Reliability, by_reliability};
pub use task::{Action, ActionPlan, Role};
