//! One task of several robots: the best plan and the best coalition for it, exactly.
//!
//! A coalition with its roles is an assignment of roles to robots, and the other way round: so no
//! coalitions need be listed, and each plan is one assignment. A sum or a mean takes the least sum;
//! the largest takes a bottleneck assignment, for which the least sum would be wrong.

use super::amount::Amount;
use super::assignment::{AssignmentError, assign};
use super::bottleneck::bottleneck;
use super::cost::Costs;
use super::memory::Memory;
use super::task::{Combine, Plan, Task};

/// The best plan of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coalition {
    /// Number of the plan among those of the task.
    pub plan: usize,
    /// Cost of the task, in parts of a unit.
    pub cost: u64,
}

/// The plan and the robots that do a task at the least cost, whatever it costs to leave it undone.
/// [`Memory::column`] is the robot of each role. Of equally good plans the one with the fewest
/// roles is taken, and of these the first.
///
/// That the plan's roles are assigned best is proven as for [`assign`] and [`bottleneck`]; that
/// another plan is no better is seen by the same for each.
///
/// ```
/// use cotama_core::team::{Combine, Cost, Costs, Fixed, Plan, Task, coalition};
/// let (alone, both) = ([67, 90].map(Cost::new), [68, 99, 80, 70].map(Cost::new));
/// let plan = |costs, extra| Plan { roles: Costs::new(costs, 2).unwrap(), extra };
/// let plans = [plan(&alone, 0), plan(&both, 0)];
/// let task = Task { skip: None, combine: Combine::Mean, plans: &plans };
/// let mut fixed = Fixed::<i32, 2, 2>::new();
/// let best = coalition(&task, 2, &mut fixed.memory()).unwrap();
/// assert_eq!((best.plan, best.cost), (0, 134)); // in halves: 67, against (68 + 70) / 2
/// ```
///
/// # Errors
/// [`AssignmentError`]: that of the last plan, where none can be carried out.
pub fn coalition<N: Amount>(
    task: &Task<'_>,
    denominator: u32,
    memory: &mut Memory<'_, N>,
) -> Result<Coalition, AssignmentError> {
    let mut best: Option<Coalition> = None;
    let mut failed = AssignmentError::Infeasible { rows: 0, columns: 0 };
    let mut solved = None;
    let roles = |plan: usize| task.plans.get(plan).map_or(usize::MAX, |it| it.roles.rows());
    for number in 0..task.plans.len() {
        let Some(plan) = task.plans.get(number) else { break };
        let least = |best: Coalition| {
            (best.cost, roles(best.plan)) <= (floor(task, plan, denominator), plan.roles.rows())
        };
        if best.is_some_and(least) {
            continue;
        }
        solved = Some(number);
        match staff(task, plan, denominator, memory) {
            Ok(cost) => {
                let better = |it: Coalition| (cost, plan.roles.rows()) < (it.cost, roles(it.plan));
                if best.is_none_or(better) {
                    best = Some(Coalition { plan: number, cost });
                }
            }
            Err(error @ AssignmentError::Infeasible { .. }) => failed = error,
            Err(error) => return Err(error),
        }
    }
    let Some(found) = best else { return Err(failed) };
    debug_assert!(found.plan < task.plans.len(), "a plan of the task");
    if solved != Some(found.plan)
        && let Some(plan) = task.plans.get(found.plan)
    {
        staff(task, plan, denominator, memory)?;
    }
    Ok(found)
}

/// Gives the roles of a plan to robots, and says what that costs.
fn staff<N: Amount>(
    task: &Task<'_>,
    plan: &Plan<'_>,
    denominator: u32,
    memory: &mut Memory<'_, N>,
) -> Result<u64, AssignmentError> {
    match task.combine {
        Combine::Sum | Combine::Mean => _ = assign(&plan.roles, memory)?,
        Combine::Max => _ = bottleneck(&plan.roles, memory)?,
    }
    Ok(staffed(task, plan, denominator, |role| memory.column(role)))
}

/// Returns the cost of a plan with these robots in its roles.
fn staffed(
    task: &Task<'_>,
    plan: &Plan<'_>,
    denominator: u32,
    robot: impl Fn(usize) -> Option<usize>,
) -> u64 {
    let roles: &Costs<'_> = &plan.roles;
    let cost = |role| roles.cost(role, robot(role)?);
    debug_assert!((0..roles.rows()).all(|role| cost(role).is_some()), "each role has a robot");
    let costs = (0..roles.rows()).filter_map(cost);
    task.cost(plan, denominator, costs)
}

/// A plan costs this at least: each role its cheapest robot.
fn floor(task: &Task<'_>, plan: &Plan<'_>, denominator: u32) -> u64 {
    let cheapest = |role| plan.roles.row(role).flatten().min();
    task.cost(plan, denominator, (0..plan.roles.rows()).filter_map(cheapest))
}
