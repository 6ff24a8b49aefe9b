//! A team of robots in one building: tasks are announced, bid for, awarded and done, over a
//! network that loses messages, by robots that fail (F. Rohrmueller, *Cooperative Action
//! Selection*, dissertation, TU München 2011, ch. 3).
//!
//! ```text
//! Scenario  task, scenarios   robots, tasks, faults, network: all that a run needs
//!  -> World world             an event at a time, to the millisecond
//!      auctioneer, awards     announces, awards, watches, puts up again
//!      succession             who goes on when it fails
//!      robot, bidding         each robot's broker and bidder
//!      working, driver        each robot under COTAMA's decisional component
//!      network                delay, loss, copies, counts
//!  -> Run   record            numbers; Trace: what happened; cotama_pages::team: a page
//! ```
//!
//! *The world* is a [`Floor`]: places, ways, distances, which may be those of paths that are
//! planned on a [floor of walls and rooms](floors); a robot is then on its path, at the length that
//! it has driven. An object lies somewhere, or is on board; where it is, everybody knows. *A robot*
//! runs under the supervisors that its [file](cotama_models::team::scenario::RobotSpec) makes, as
//! in a [mission](crate::robots): a task is a mission of four objectives (drive, receive, drive,
//! deliver), its path planned for two seconds a drive; failures raise flags with the latencies of
//! the file, and what its supervisors make of them (another configuration, a safe stop, a question
//! that nobody answers) is all that the team sees. A bid is the time of the drives, at the speed of
//! the configuration that works, and of the hands. Where the robot comes to need more than it
//! pledged, or goes safe, it gives the task back with its error class; what it has on board others
//! fetch from it.
//!
//! *The protocol* is that of the thesis, with what it leaves out. Bids and acknowledgements have
//! deadlines, and who is silent is asked again. A message of another round changes nothing. An
//! award holds until a date that the auctioneer prolongs while it hears of the robot: beyond it the
//! robot stops by itself, and only then is the task put up again, so that no two robots work for
//! it, whoever cannot hear whom (clocks are taken to agree). Withdrawn awards are confirmed, and
//! the end of a role is said until it is heard. The auctioneer is at a desk, or at a robot
//! (strategies i and ii), or the next robot takes over when it fails (iii): what it knows is copied
//! to two others before it acts.
//!
//! *Who does what* is computed by [`cotama_core::team`]: all open tasks at once at the least cost,
//! or by the greedy rounds of the thesis, or task by task, for comparison. Brokers share coalitions
//! as in Algorithm A.1 where
//! [`Formation::Distributed`](cotama_models::team::scenario::Formation) says so.
//!
//! The same scenario gives the same bytes: random numbers come from named streams, and of one
//! moment letters come first, then the auctioneer, then robots by their numbers.
//!
//! ```
//! use cotama_sim::fleet::{record::Fate, run, scenarios::{FleetOptions, fleet}};
//! let options = FleetOptions { robots: 6, tasks: 9, failures: 1, ..FleetOptions::default() };
//! let run = run(&fleet(&options));
//! assert!(run.is_sound() && run.count(Fate::Open) == 0);
//! ```

mod allocate;
mod award;
mod bid;
mod charge;
mod driver;
pub mod floors;
mod ledger;
mod message;
mod network;
mod passages;
pub mod record;
pub mod scenarios;
mod skills;
pub mod trace;
mod world;

#[cfg(test)]
mod tests;

pub use cotama_models::team::scenario::{Floor, Place, Quality, Scenario, Spot};
pub use message::Kind;

use record::{Record, Run};
pub use world::Planted;
use world::World;

/// Runs a scenario; its numbers.
pub fn run(scenario: &Scenario) -> Run {
    World::new(scenario, false, None).run().0
}

/// Runs a scenario with a defect.
pub fn run_with(scenario: &Scenario, planted: Option<Planted>) -> Run {
    World::new(scenario, false, planted).run().0
}

/// Runs a scenario; its numbers, and what happened.
pub fn run_recorded(scenario: &Scenario) -> (Run, Vec<Record>) {
    World::new(scenario, true, None).run()
}
