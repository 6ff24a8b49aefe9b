//! Roles of tasks, and the actions of which they consist.

use super::capability::CapabilitySet;
use super::constraint::Constraint;

/// Something that a robot does (2.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Action<'a> {
    /// Name of the action.
    pub name: &'a str,
    /// The capabilities needed (def. 3.11).
    pub needs: Constraint<'a>,
}

/// A sequence of actions of one robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActionPlan<'a> {
    /// Name of the plan.
    pub name: &'a str,
    /// The actions, in their order.
    pub actions: &'a [Action<'a>],
}

/// The part of one robot in a task: a subtask of the thesis (def. 3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Role<'a> {
    /// Name of the role.
    pub name: &'a str,
    /// One of these is carried out.
    pub plans: &'a [ActionPlan<'a>],
}

impl ActionPlan<'_> {
    /// Whether these capabilities are enough for all actions (3.6).
    pub fn possible(&self, set: CapabilitySet) -> bool {
        self.actions.iter().all(|it| it.needs.holds(set))
    }
}

impl Role<'_> {
    /// Whether these capabilities are enough for one of the action plans.
    pub fn possible(&self, set: CapabilitySet) -> bool {
        self.plans.iter().any(|it| it.possible(set))
    }
}
