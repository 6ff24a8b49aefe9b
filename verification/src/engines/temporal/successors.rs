//! What the engines of temporal logic need to know of states.

use crate::explicit::{BitSet, Goal, Graph};
use cotama_core::net::TransitionId;

/// States with the firings between them, numbered from 0, the first one, from which all others are
/// reached: the markings of a net, or the classes of states of a time net.
pub trait Successors: Sync {
    /// How many states there are.
    fn states(&self) -> usize;

    /// How many firings there are between them.
    fn arcs(&self) -> usize;

    /// The states that follow a state, one for each firing.
    fn successors(&self, state: u32) -> &[u32];

    /// What fires, for each of [`Successors::successors`], in the order of transitions. Where
    /// classes are split, a transition may be there several times.
    fn transitions(&self, state: u32) -> Vec<TransitionId>;

    /// The states of which something is true, looked at by so many threads.
    fn satisfying(&self, goal: Goal<'_>, jobs: usize) -> BitSet;

    /// A shortest way from the first state to another one.
    fn way(&self, to: u32) -> Vec<TransitionId>;
}

impl Successors for Graph {
    fn states(&self) -> usize {
        Self::states(self)
    }

    fn arcs(&self) -> usize {
        Self::arcs(self)
    }

    #[inline]
    fn successors(&self, state: u32) -> &[u32] {
        Self::successors(self, state)
    }

    fn transitions(&self, state: u32) -> Vec<TransitionId> {
        Self::transitions(self, state)
    }

    fn satisfying(&self, goal: Goal<'_>, jobs: usize) -> BitSet {
        Self::satisfying(self, goal, jobs)
    }

    fn way(&self, to: u32) -> Vec<TransitionId> {
        Self::way(self, to)
    }
}
