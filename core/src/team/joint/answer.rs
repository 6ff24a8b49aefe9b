//! What a search is given, and what it answers.

use super::{Column, Level, Open, Slot, Way};
use crate::team::RobotSet;

/// Working memory for teams of up to `N` robots.
#[derive(Debug)]
pub struct JointMemory<'m, const N: usize> {
    /// One for each role of each plan.
    pub roles: &'m mut [[i64; N]],
    /// One for each plan.
    pub ways: &'m mut [Way],
    /// One for each task.
    pub slots: &'m mut [Slot],
    /// The more, the larger the losses that can be searched; about a thousand a task are plenty.
    pub columns: &'m mut [Column],
    /// As many as robots times roles of the largest plan.
    pub open: &'m mut [Open],
    /// One more than robots.
    pub levels: &'m mut [Level<N>],
}

/// What is known at the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The least cost, in parts of a unit.
    Optimal {
        /// The cost.
        cost: u64,
    },
    /// Some tasks that must be done cannot be staffed together:
    /// [`in_conflict`](super::Joint::in_conflict) tells which.
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
pub struct Solved {
    /// What is known.
    pub outcome: Outcome,
    /// Steps: about as many as rows of costs were looked at.
    pub steps: u64,
    /// Nodes of the search.
    pub nodes: u64,
}
