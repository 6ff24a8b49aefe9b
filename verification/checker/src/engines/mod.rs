//! The common parts of the checker's engines: tasks, budgets, the knowledge of a net, and findings.
//!
//! Each is in the module of what it does; [`ALL`] lists them. The checker asks those that suit a
//! task, the cheapest first: [`check`](mod@crate::check).

pub mod bounds;
mod budget;
mod capped;
pub(crate) mod components;
pub mod coverability;
mod engine;
pub mod explicit;
mod known;
mod reason;
pub mod reductions;
pub mod structural;
pub mod stubborn;
mod task;
pub mod temporal;
pub mod tpn;

pub use budget::Budget;
pub use capped::Capped;
pub use engine::{Bid, Engine};
pub(crate) use known::STORED;
pub use known::{Known, Made};
pub use reason::Reason;
pub use task::{Extent, Finding, Found, Task};

use coverability::{Coverability, FewOmegas};
use explicit::{Explicit, Few, Stored};
use structural::Structural;
use stubborn::{Glance, Stubborn};
use temporal::{Branching, Runs, StoredBranching};
use tpn::StateClasses;

/// All engines. Which of them is asked first is told by what they ask for.
pub const ALL: &[&dyn Engine] = &[
    &Glance,
    &Structural,
    &Capped,
    &Stored,
    &StoredBranching,
    &Few,
    &FewOmegas,
    &Coverability,
    &Runs,
    &Stubborn,
    &Branching,
    &Explicit,
    &StateClasses,
];
