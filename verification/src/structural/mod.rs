//! The engine that looks at the structure of a net and visits no marking.
//!
//! It proves that markings are not reachable, whatever their number is, and never claims more than
//! it proves: what it cannot prove is [`Answer::Unknown`]. Sometimes a marking that it finds
//! possible is also reached in a straight way; then the answer is the way there. Every proof is
//! plain data of [`certificate`] that is easy to check again.
//!
//! How: the marking is the initial one plus what firings change (the state equation), solved in
//! exact integers by the simplex method; traps that would lose their tokens are added as
//! constraints until there are none; what is left of fractions is split in cases.

pub mod certificate;
mod class;
mod clauses;
mod commoner;
mod engine;
mod flow;
mod program;
mod row;
mod search;
mod siphon;
mod structure;
mod tableau;
mod work;

pub use class::{Class, class};
pub use commoner::{Commoner, commoner};
pub use engine::Structural;
pub use flow::{
    Flow, Semiflows, place_invariants, place_semiflows, transition_invariants, transition_semiflows,
};
pub(crate) use siphon::minimal_siphons_within;
pub use siphon::{Siphon, Siphons, greatest_siphon, greatest_trap, minimal_siphons, never_marked};
pub use structure::Structure;

use crate::explicit;
use cotama_core::net::TransitionId;
use std::time::Instant;

/// What one question may cost. The same limits without a deadline give the same answer on every
/// machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Numbers and arcs that are looked at.
    pub work: u64,
    /// Cases that are told apart.
    pub nodes: u32,
    /// When to stop.
    pub deadline: Option<Instant>,
}

impl Default for Limits {
    /// Some tenths of a second.
    fn default() -> Self {
        Self { work: 20_000_000, nodes: 1_000, deadline: None }
    }
}

impl Limits {
    /// What a question may cost beside other engines. Each number of a row takes 16 bytes, and of
    /// what is looked at at most a quarter is kept.
    pub(crate) fn within(limits: &explicit::Limits) -> Self {
        let usual = Self::default();
        Self { work: usual.work.min(limits.bytes / 64), deadline: limits.deadline, ..usual }
    }
}

/// A limit that was reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// [`Limits::work`]
    Work,
    /// [`Limits::nodes`], or how deep cases may be nested.
    Nodes,
    /// A number passed 63 bits.
    Overflow,
    /// [`Limits::deadline`]
    Time,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// A limit was reached.
    Limit(Stop),
    /// The state equation and all traps allow this marking; whether it is reachable was not found
    /// out.
    Candidate(Vec<u32>),
}

/// Whether what was asked for is reachable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer<P> {
    /// It is not, with the proof.
    Impossible(P),
    /// It is, when these transitions fire one after the other.
    Reachable(Vec<TransitionId>),
    /// It was not found out.
    Unknown(Unknown),
}

impl<P> Answer<P> {
    /// The same with another proof.
    pub fn map<Q>(self, proof: impl FnOnce(P) -> Q) -> Answer<Q> {
        match self {
            Self::Impossible(it) => Answer::Impossible(proof(it)),
            Self::Reachable(trace) => Answer::Reachable(trace),
            Self::Unknown(unknown) => Answer::Unknown(unknown),
        }
    }
}
