//! The decisional level of a robot at work, from flags to requests, without heap: the same for the
//! simulator and for a microcontroller.
//!
//! A robot's file makes [`Tables`] and a system of supervisors
//! ([`robots::supervisors`](https://docs.rs/cotama-models)); `cotama table ROBOT MISSION` prints
//! both as Rust. In each period, in this order (Durand et al., TAROS 2010, Sections III and V):
//!
//! 1. [`Decider::perceive`]: new flags that are not masked are diagnosed ([`Hidden::diagnose`]),
//!    what they are taken for waits to be told, settings see whether they are still needed, and
//!    what works again is noticed;
//! 2. [`Decider::period`]: the supervisors take a round and are then told *one* thing, the oldest
//!    report first, else what the robot, the mission or the operator has to say. So a run is a run
//!    of the system that was checked: [`Told`] is its alphabet;
//! 3. [`Decider::requests`]: what the scheduler and the robot are to do now.
//!
//! A simulator that knows more than flags takes the same steps one by one.

mod adapted;
mod asked;
mod decider;
mod diagnosis;
mod masked;
mod motion;
#[cfg(kani)]
pub mod proofs;
mod sets;
mod supervisors;
mod tables;
mod told;
mod untold;

pub use adapted::{Adapted, SOUND_FOR};
pub use decider::{Decider, Drive, PATIENCE, Perceived, Requests, Round};
pub use diagnosis::{Rows, diagnose};
pub use masked::Hidden;
pub use motion::permit;
pub use supervisors::Level;
pub use tables::{
    Act, Acting, Configuration, Failure, Loss, MAX_CONFIGURATIONS, MAX_FAILURES, MAX_FLAGS,
    MAX_LOSSES, MAX_MASKS, MAX_REPORTS, Mask, Report, Setting, Step, SubObjective, Tables, event,
    place, transition,
};
pub use told::{Cause, Global, Mode, Told, Where};
