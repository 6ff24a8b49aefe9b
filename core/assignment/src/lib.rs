//! Winner determination in a team of robots, at the least cost, with its proof (F. Rohrmueller,
//! *Cooperative Action Selection*, dissertation, TU München 2011, ch. 3).
//!
//! - [`assign`]: rows to columns at the least sum, as roles to robots; who cannot has no cost,
//!   which is a type; [`is_least`] proves an answer by its prices, [`conflict`] that there is none
//! - [`bottleneck`]: the largest cost as small as can be, then the least sum
//! - [`coalition`]: one task with several plans of several roles
//! - [`winners`]: winner determination for all tasks, within a step budget, with a true bound
#![no_std]
#![cfg_attr(any(test, kani), allow(clippy::pedantic))]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(test)]
extern crate std;

mod amount;
mod assignment;
mod bottleneck;
mod coalition;
mod cost;
mod equality;
mod matching;
mod memory;
mod problem;
mod proof;
#[cfg(kani)]
pub mod proofs;
mod scan;
mod task;
pub mod winners;

pub use amount::Amount;
pub use assignment::{AssignmentError, assign};
pub use bottleneck::{Bottleneck, bottleneck};
pub use coalition::{Coalition, coalition};
pub use cost::{Cost, Costs};
pub use memory::{Fixed, Memory};
pub use problem::{RobotSet, Team, TeamError};
pub use proof::{ProofError, conflict, is_least};
pub use task::{Combine, Plan, Task};
