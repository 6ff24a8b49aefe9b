//! Who does what in a team of robots.

mod amount;
mod assignment;
mod bottleneck;
mod coalition;
mod cost;
pub mod joint;
mod memory;
mod problem;
mod proof;
mod scan;
mod task;
pub mod thesis;

pub use amount::Amount;
pub use assignment::{Unassigned, assign};
pub use bottleneck::{Bottleneck, bottleneck};
pub use coalition::{Coalition, coalition};
pub use cost::{Cost, Costs};
pub use memory::{Fixed, Memory};
pub use problem::{RobotSet, Team, TeamError};
pub use proof::{Flaw, conflict, is_least};
pub use task::{Combine, Plan, Task};
