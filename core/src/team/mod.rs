//! Who does what in a team of robots.

mod assignment;
mod cost;

pub use assignment::{Assigned, Column, Infeasible, Row, assign};
pub use cost::{Cost, Costs};
