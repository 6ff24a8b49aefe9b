//! Time Petri nets: their state classes, what they can reach, how long they take to respond.
//!
//! | function | answers |
//! | --- | --- |
//! | [`classes`] | the state class graph: its size, deadlocks, bounded or not |
//! | [`untimed`] | how many markings there would be without time |
//! | [`bound`], [`bound_from_start`] | least and most time to a marked place |
//! | [`reach`], [`deadlock`] | whether a marking can be reached, and what to fire when |
//! | [`schedule`] | dates for a firing sequence |
//! | [`from_net`], [`exported`], [`to_net`] | a [`Net`](cotama_core::net::Net) as one, and back |
//!
//! [`TimeNet`] says what a net means; `tina` reads it from files. All answers are
//! exact, in dense time, with open bounds where they are open. What a limit cuts short is said to
//! be unknown.

mod atomic;
mod bound;
mod classes;
mod convert;
mod domain;
mod engine;
mod explore;
mod graph;
mod growth;
mod in_time;
mod index;
mod markings;
mod response;
mod schedule;
mod untimed;
mod zone;

pub(crate) use atomic::atomic;
pub use classes::{ClassId, Classes};
pub use convert::{Converted, Difference, NotANet, exported, from_net, to_net};
pub use cotama_property::limits::{Limit, Limits};
pub use cotama_property::schedule::{Date, Schedule, Step};
pub use cotama_property::time::{Interval, TimeNet, TimeNetDefect, TimePlace, TimeTransition};
pub use engine::StateClasses;
pub use explore::classes;
pub(crate) use graph::ClassGraph;
pub use response::{Response, Time, bound, bound_from_start};
pub(crate) use response::{longest, measured};
pub use schedule::{NoSchedule, Reach, deadlock, reach, schedule};
pub use untimed::{Untimed, markings as untimed};
