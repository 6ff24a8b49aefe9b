//! A team of robots in one building: tasks are announced, bid for, awarded and done, over a
//! network that loses messages, by robots that fail (F. Rohrmueller, *Cooperative Action
//! Selection*, dissertation, TU München 2011, ch. 3).
mod allocate;
pub mod campaign;
mod driver;
mod floor;
mod message;
mod network;
pub mod record;
pub mod scenarios;
pub mod task;
pub mod trace;
mod world;

#[cfg(test)]
mod tests;

pub use floor::{Floor, Place, Spot};
pub use message::Kind;
pub use network::Quality;

use record::{Record, Run};
use task::Scenario;
use world::World;

/// Runs a scenario; its numbers.
pub fn run(scenario: &Scenario) -> Run {
    World::new(scenario, false, None).run().0
}

/// Runs a scenario; its numbers, and what happened.
pub fn run_recorded(scenario: &Scenario) -> (Run, Vec<Record>) {
    World::new(scenario, true, None).run()
}
