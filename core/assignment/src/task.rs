//! Tasks, their plans, and what a coalition costs (F. Rohrmueller, dissertation, TU München 2011,
//! 3.3 and 3.4).

use super::cost::{Cost, Costs};

/// How the costs of the roles of a plan become one cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combine {
    /// Their sum: what counts is resources.
    Sum,
    /// Their mean: what counts is speed (3.21).
    Mean,
    /// The largest: the slowest member counts.
    Max,
}

/// One way to do a task: each role needs a robot of its own.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// Cost of each robot in each role: roles are rows, robots are columns.
    pub roles: Costs<'a>,
    /// Yield that the plan lacks to the best plan of the task.
    pub extra: u32,
}

/// A task: one of its plans is carried out, or it is left undone. A task of one robot has one plan
/// with one role.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// Cost of leaving the task undone; `None` where it must be done.
    pub skip: Option<Cost>,
    /// How costs of roles become one.
    pub combine: Combine,
    /// The plans.
    pub plans: &'a [Plan<'a>],
}

impl Task<'_> {
    /// Weight of one unit of a role's cost in the task's cost, in parts of a unit.
    pub(super) fn weight(&self, denominator: u32, roles: usize) -> u64 {
        match self.combine {
            Combine::Sum | Combine::Max => u64::from(denominator),
            Combine::Mean => u64::from(denominator).checked_div(roles as u64).unwrap_or(0),
        }
    }

    /// Returns the cost of the task by this plan, given the costs of its roles: in parts of a unit,
    /// of which `denominator` make one. A mean is exact where the number of roles divides that.
    pub fn cost(
        &self,
        plan: &Plan<'_>,
        denominator: u32,
        roles: impl Iterator<Item = Cost>,
    ) -> u64 {
        let costs = roles.map(|it| u64::from(it.get()));
        let joint = match self.combine {
            Combine::Sum | Combine::Mean => costs.fold(0, u64::saturating_add),
            Combine::Max => costs.fold(0, u64::max),
        };
        let extra = u64::from(denominator).saturating_mul(u64::from(plan.extra));
        joint.saturating_mul(self.weight(denominator, plan.roles.rows())).saturating_add(extra)
    }
}
