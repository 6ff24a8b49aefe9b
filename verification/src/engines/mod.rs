//! What the engines of the checker have in common: what they are asked, what they may use, what is
//! known already, and what they find.
//!
//! Each is in the module of what it does; [`ALL`] lists them. The checker asks those that suit a
//! task, the cheapest first: [`check`](mod@crate::check).

mod budget;
mod engine;
mod known;
mod reason;
mod task;

pub use budget::Budget;
pub use engine::{Bid, Engine};
pub use known::{Known, Made};
pub use reason::Reason;
pub use task::{Extent, Finding, Found, Task};

use crate::coverability::{Coverability, FewOmegas};
use crate::explicit::{Explicit, Few, Stored};
use crate::structural::Structural;
use crate::stubborn::{Glance, Stubborn};
use crate::temporal::{Branching, Runs, StoredBranching};
use crate::tpn::StateClasses;

/// All engines. Which of them is asked first is told by what they ask for.
pub const ALL: &[&dyn Engine] = &[
    &Glance,
    &Structural,
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
