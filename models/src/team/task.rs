//! What is to be done.

use super::capability::{CapabilitySet, Robot};
use super::constraint::Constraint;
use cotama_core::team::Combine;

/// Something that a robot does (2.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Action<'a> {
    /// Its name.
    pub name: &'a str,
    /// What it needs (def. 3.11).
    pub needs: Constraint<'a>,
}

/// A sequence of actions of one robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActionPlan<'a> {
    /// Its name.
    pub name: &'a str,
    /// The actions, in their order.
    pub actions: &'a [Action<'a>],
}

/// What one robot does for a task: a subtask of the thesis (def. 3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Role<'a> {
    /// Its name.
    pub name: &'a str,
    /// One of these is carried out.
    pub plans: &'a [ActionPlan<'a>],
}

/// One way to do a task: each role needs a robot of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TaskPlan<'a> {
    /// Its name.
    pub name: &'a str,
    /// The roles.
    pub roles: &'a [Role<'a>],
    /// The utility that it yields less than the best plan of the task.
    pub extra: u32,
}

/// Something that is to be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Task<'a> {
    /// Its name.
    pub name: &'a str,
    /// What it yields: what it costs to leave it undone (2.6, 2.7).
    pub utility: u32,
    /// How the costs of the roles become one.
    pub combine: Combine,
    /// One of these is carried out.
    pub plans: &'a [TaskPlan<'a>],
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

impl TaskPlan<'_> {
    /// Whether the robot can do all of the task alone; of plans of several roles none can.
    pub fn possible_alone(&self, robot: &Robot<'_>) -> bool {
        matches!(self.roles, [role] if role.possible(robot.capabilities()))
    }
}

impl Task<'_> {
    /// Whether some plan has two roles or more: MR in the thesis, else SR (def. 3.3).
    pub fn is_for_several(&self) -> bool {
        self.plans.iter().any(|it| it.roles.len() > 1)
    }

    /// Whether one robot with this capability set can do it by one of its plans of one role (3.6).
    pub fn possible_alone(&self, robot: &Robot<'_>) -> bool {
        self.plans.iter().any(|it| it.possible_alone(robot))
    }
}
