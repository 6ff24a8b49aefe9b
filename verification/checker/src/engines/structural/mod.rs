//! The engine that looks at the structure of a net and visits no marking.
//!
//! It proves that markings are not reachable, whatever their number is, and never claims more than
//! it proves: what it cannot prove is [`Answer::Unknown`]. Sometimes a marking that it finds
//! possible is also reached in a straight way; then the answer is the path there. Every proof is
//! plain data of [`certificate`] that is easy to check again.
//!
//! How: the marking is the initial one plus what firings change (the state equation), solved in
//! exact integers by the simplex method; traps that would lose their tokens are added as
//! constraints until there are none; what is left of fractions is split in cases.

pub use cotama_certificate::proof as certificate;
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
pub use cotama_property::limits::{Limit, Limits};
pub use engine::Structural;
pub use flow::{
    Flow, Semiflows, place_invariants, place_semiflows, transition_invariants, transition_semiflows,
};
pub(crate) use siphon::minimal_siphons_within;
pub use siphon::{Siphon, Siphons, greatest_siphon, greatest_trap, minimal_siphons, never_marked};
pub use structure::Structure;

use cotama_core::net::TransitionId;
use cotama_property::Linear;
use cotama_property::pt::Pt;

/// How much is done for one question. The same effort without a deadline gives the same answer on
/// every machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Numbers and arcs that are looked at.
    pub work: u64,
    /// Cases that are told apart.
    pub nodes: u32,
}

impl Default for Effort {
    /// Some tenths of a second.
    fn default() -> Self {
        Self { work: 20_000_000, nodes: 1_000 }
    }
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// A limit was reached; [`Limit::Work`]: that of the effort, or of how deep cases are nested.
    Limit(Limit),
    /// The state equation and all traps allow this marking; whether it is reachable was not found
    /// out.
    Candidate(Vec<u32>),
}

/// Whether what was asked for is reachable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer<P> {
    /// No such marking is reachable, with the proof.
    Impossible(P),
    /// Such a marking is reachable, by firing these transitions one after the other.
    Reachable(Vec<TransitionId>),
    /// The question was not decided.
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

impl Answer<certificate::Refutation> {
    /// Returns whether the proof, if it is one, refutes the goal for who checks it again.
    fn is_proved(&self, pt: &Pt, dead: &certificate::DeadTransitions, goal: &[Linear]) -> bool {
        let Self::Impossible(proof) = self else { return true };
        proof.refutes(pt, &|it| dead.can_fire(it), &mut goal.to_vec(), false)
    }
}
