//! Conditions on a tree, and the supervisor beside it, after a tick.

use crate::machine::{Machine, Status, Watched};
use crate::tree::Answer;

/// A condition on the nodes after a tick.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Condition {
    /// `true` or `false`.
    Is(bool),
    /// A node's status after the tick.
    Has(usize, Status),
    /// A node's last answer within the tick.
    Answers(usize, Answer),
    /// A node was ticked.
    Ticked(usize),
    /// A place of the supervisor is marked.
    Marked(usize),
    /// `done`: the root has answered SUCCESS, FAILURE or SKIPPED, or an exception ended the run.
    Done,
    /// `!p`.
    Not(Box<Condition>),
    /// `p & q`.
    And(Box<Condition>, Box<Condition>),
    /// `p | q`.
    Or(Box<Condition>, Box<Condition>),
}

impl Condition {
    /// Adds what the condition asks for.
    pub(crate) fn watched(&self, into: &mut Watched) {
        match self {
            Condition::Answers(node, _) | Condition::Ticked(node) => {
                into.nodes.insert(*node);
            }
            Condition::Marked(_) => into.net = true,
            Condition::Not(it) => it.watched(into),
            Condition::And(a, b) | Condition::Or(a, b) => {
                a.watched(into);
                b.watched(into);
            }
            Condition::Has(node, _) => {
                into.statuses.insert(*node);
            }
            Condition::Is(_) | Condition::Done => {}
        }
    }

    /// Returns whether a condition holds of a machine after a tick that may have ended the run.
    pub(crate) fn holds(&self, machine: &Machine, is_end: bool) -> bool {
        let answer = |node: usize| machine.watched[node].map_or(0, |it| machine.cells[it]);
        match self {
            Condition::Is(it) => *it,
            Condition::Has(node, status) => machine.status(*node) == *status,
            Condition::Answers(node, it) => answer(*node) == *it as u32 + 1,
            Condition::Ticked(node) => answer(*node) != 0,
            Condition::Marked(place) => machine.is_marked(*place),
            Condition::Done => is_end,
            Condition::Not(it) => !it.holds(machine, is_end),
            Condition::And(a, b) => a.holds(machine, is_end) && b.holds(machine, is_end),
            Condition::Or(a, b) => a.holds(machine, is_end) || b.holds(machine, is_end),
        }
    }
}
