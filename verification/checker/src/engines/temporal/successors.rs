//! The interface between the engines of temporal logic and states.

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

    /// Returns the transition fired for each of [`Successors::successors`], in the order of
    /// transitions. Where classes are split, a transition may be there several times.
    fn transitions(&self, state: u32) -> Vec<TransitionId>;

    /// The states of which something is true, looked at by so many threads.
    fn satisfying(&self, goal: Goal<'_>, jobs: usize) -> BitSet;

    /// A shortest path from the first state to another one.
    fn path(&self, to: u32) -> Vec<TransitionId>;

    /// Whether no transition leads to one state from two.
    fn is_injective(&self) -> bool {
        true
    }
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

    fn path(&self, to: u32) -> Vec<TransitionId> {
        Self::path(self, to)
    }

    fn is_injective(&self) -> bool {
        self.is_injective
    }
}
