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
//! [`TimeNet`] says what a net means; [`tina`](crate::tina) reads it from files. All answers are
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
mod net;
mod response;
mod schedule;
mod untimed;
mod zone;

pub(crate) use atomic::atomic;
pub use classes::{ClassId, Classes};
pub use convert::{Converted, Difference, NotANet, exported, from_net, to_net};
pub use engine::StateClasses;
pub use explore::classes;
pub(crate) use graph::ClassGraph;
pub use net::{Interval, TimeNet, TimeNetDefect, TimePlace, TimeTransition};
pub use response::{Response, Time, bound, bound_from_start};
pub(crate) use response::{longest, measured};
pub use schedule::{Date, NoSchedule, Reach, Schedule, Step, deadlock, reach, schedule};
pub use untimed::{Untimed, markings as untimed};

use std::fmt;

/// How far to go.
#[derive(Clone, Copy)]
pub struct Limits<'s> {
    /// The most classes.
    pub classes: usize,
    /// About how many bytes they may take.
    pub bytes: usize,
    /// Asked now and then whether to stop.
    pub stop: &'s dyn Fn() -> bool,
}

impl Default for Limits<'_> {
    /// 100,000,000 classes, 4 GiB.
    fn default() -> Self {
        Self { classes: 100_000_000, bytes: 4 << 30, stop: &|| false }
    }
}

impl Limits<'_> {
    /// Looks at memory and interruption, at every 256th step.
    fn check(&self, step: u32, bytes: impl Fn() -> usize) -> Result<(), Stop> {
        if !step.is_multiple_of(256) {
            return Ok(());
        }
        if (self.stop)() {
            return Err(Stop::Interrupt);
        }
        if bytes() > self.bytes { Err(Stop::Bytes) } else { Ok(()) }
    }
}

/// Why an answer is not complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The net is unbounded, so there is no end; this is a proof.
    Unbounded,
    /// [`Limits::classes`] was reached.
    Classes,
    /// [`Limits::bytes`] was reached.
    Bytes,
    /// [`Limits::stop`] said so.
    Interrupt,
    /// A place would hold more than 4,294,967,295 tokens, or a time is longer than 2⁶⁰.
    Overflow,
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unbounded => "the net is unbounded",
            Self::Classes => "the limit of classes was reached",
            Self::Bytes => "the limit of memory was reached",
            Self::Interrupt => "it was interrupted",
            Self::Overflow => "a number of tokens or a time is too large",
        })
    }
}
