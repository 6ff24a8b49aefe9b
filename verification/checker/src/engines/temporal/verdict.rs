//! The verdict on a formula, or why there is none.

use crate::explicit::Limit;
use cotama_property::run::Run;

/// The verdict on a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Whether it holds in the initial marking.
    Known {
        /// Whether it does.
        holds: bool,
        /// A run that shows it, where a run does: one that exists, or a counterexample to what is
        /// said of all.
        run: Option<Run>,
        /// How many markings were met.
        states: u64,
    },
    /// No verdict.
    Unknown {
        /// The reason.
        reason: Reason,
        /// How many markings were met.
        states: u64,
    },
}

/// Why a formula has no verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A limit was reached.
    Limit(Limit),
    /// The automaton of the formula has more than 128 conditions, or more than 16,384 moves in one
    /// state on one marking.
    Formula,
    /// The formula is of no kind that is answered here.
    Kind,
}

impl From<Limit> for Reason {
    fn from(limit: Limit) -> Self {
        Self::Limit(limit)
    }
}
