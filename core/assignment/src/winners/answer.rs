//! The input and the answers of a search.

use super::{Column, Level, Open, PlanEntry, Slot};
use crate::RobotSet;

/// Working memory for teams of up to `N` robots.
#[derive(Debug)]
pub struct WinnersMemory<'m, const N: usize> {
    /// One for each role of each plan.
    pub roles: &'m mut [[i64; N]],
    /// One for each plan.
    pub plans: &'m mut [PlanEntry],
    /// One for each task.
    pub slots: &'m mut [Slot],
    /// The more, the larger the reduced costs that can be searched; about a thousand a task are
    /// plenty.
    pub columns: &'m mut [Column],
    /// As many as robots times roles of the largest plan.
    pub open: &'m mut [Open],
    /// One more than robots.
    pub levels: &'m mut [Level<N>],
}

/// The result of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The least cost, in parts of a unit.
    Optimal {
        /// The cost.
        cost: u64,
    },
    /// Some tasks that must be done cannot be staffed together:
    /// [`in_conflict`](super::Winners::in_conflict) tells which.
    Infeasible {
        /// The robots that they compete for.
        robots: RobotSet,
    },
    /// The budget or the memory ended first.
    Unknown {
        /// The cost of the best solution found, if one was.
        cost: Option<u64>,
        /// No solution costs less.
        bound: u64,
    },
}

/// An answer, and what it took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Solved {
    /// The result.
    pub outcome: Outcome,
    /// Steps: about as many as rows of costs were looked at.
    pub steps: u64,
    /// Nodes of the search.
    pub nodes: u64,
}
