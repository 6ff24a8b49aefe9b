//! The outcome of a search for a marking.

use super::Limit;
use cotama_core::net::TransitionId;

/// The outcome of a search for a marking.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reached {
    /// There is one.
    Trace {
        /// A shortest path from the initial marking to one.
        transitions: Vec<TransitionId>,
        /// How many markings were reached: those of all levels up to the one that has it.
        states: u64,
    },
    /// No reachable marking meets the goal.
    Never {
        /// How many markings are reachable.
        states: u64,
    },
    /// No such marking was found before a limit was reached.
    Unknown {
        /// The limit.
        limit: Limit,
        /// How many markings were reached; none of them is one.
        states: u64,
    },
}

impl Reached {
    /// How many markings were reached.
    pub fn states(&self) -> u64 {
        match *self {
            Self::Trace { states, .. } | Self::Never { states } | Self::Unknown { states, .. } => {
                states
            }
        }
    }
}
