//! Coalition formation in two phases (3.4.4) over all coalitions, and over all orderings.

use super::{bit, only};
use cotama_core::team::Memory;
use cotama_core::team::RobotSet;
use cotama_core::team::assign;
use cotama_core::team::{Cost, Costs};
use cotama_core::team::{Plan, Task};

/// The best coalition, and how many were looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formed {
    /// The least cost, with its plan and its robots; `None` where no plan can be carried out.
    pub best: Option<(u64, usize, RobotSet)>,
    /// Coalitions of as many robots as some plan has roles, once for each such plan; or orderings.
    pub looked_at: u64,
}

impl Formed {
    const NONE: Self = Self { best: None, looked_at: 0 };

    fn meet(&mut self, cost: u64, plan: usize, robots: RobotSet) {
        if self.best.is_none_or(|it| cost < it.0) {
            self.best = Some((cost, plan, robots));
        }
    }
}

/// `MuRoCo`: for each plan and each coalition of its size a role assignment of least sum, then the
/// best of all (3.4.4). Where the largest cost counts this is not always the best: the roles are
/// assigned by their sum.
///
/// `entries` has room for roles times roles of the largest plan, `memory` as well. Plans for more
/// than 63 robots are passed over.
pub fn all_coalitions(
    task: &Task<'_>,
    denominator: u32,
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i32>,
) -> Formed {
    let mut formed = Formed::NONE;
    for (number, plan) in (0..task.plans.len()).zip(task.plans) {
        let (roles, robots) = (plan.roles.rows(), plan.roles.columns());
        if roles == 0 || roles > robots || robots > 63 {
            continue;
        }
        // The sets of so many robots by rising number (Gosper's hack).
        let mut set = 1_u64.wrapping_shl(roles as u32).wrapping_sub(1);
        while set < 1_u64.wrapping_shl(robots as u32) {
            formed.looked_at = formed.looked_at.saturating_add(1);
            if let Some(table) = only(&plan.roles, u128::from(set), entries)
                && assign(&table, memory).is_ok()
            {
                let cost = |role| table.cost(role, memory.column(role)?);
                let costs = (0..roles).filter_map(cost);
                formed.meet(task.cost(plan, denominator, costs), number, u128::from(set));
            }
            let low = set & set.wrapping_neg();
            let up = set.wrapping_add(low);
            let Some(rest) = (set ^ up).checked_div(low) else { break };
            set = up | (rest >> 2);
        }
    }
    formed
}

/// All orderings: each way to give the roles to robots, one after the other. `chosen` has room for
/// the roles of the largest plan. Counts the orderings of each length that a plan has.
pub fn all_orderings(task: &Task<'_>, denominator: u32, chosen: &mut [usize]) -> Formed {
    let mut formed = Formed::NONE;
    for (number, plan) in (0..task.plans.len()).zip(task.plans) {
        if let Some(chosen) = chosen.get_mut(..plan.roles.rows()) {
            orderings_of(task, plan, (number, denominator), chosen, &mut formed);
        }
    }
    formed
}

fn orderings_of(
    task: &Task<'_>,
    plan: &Plan<'_>,
    (number, denominator): (usize, u32),
    chosen: &mut [usize],
    formed: &mut Formed,
) {
    let roles: &Costs<'_> = &plan.roles;
    let (mut depth, mut taken, mut next): (usize, RobotSet, usize) = (0, 0, 0);
    loop {
        let free = (next..roles.columns()).find(|it| taken & bit(*it) == 0);
        if let (Some(robot), Some(slot)) = (free, chosen.get_mut(depth)) {
            *slot = robot;
            if depth.saturating_add(1) == chosen.len() {
                formed.looked_at = formed.looked_at.saturating_add(1);
                let cost = |(role, robot): (usize, &usize)| roles.cost(role, *robot);
                let able = chosen.iter().enumerate().all(|it| cost(it).is_some());
                if able {
                    let costs = chosen.iter().enumerate().filter_map(cost);
                    let cost = task.cost(plan, denominator, costs);
                    formed.meet(cost, number, taken | bit(robot));
                }
                next = robot.saturating_add(1);
            } else {
                (taken, next) = (taken | bit(robot), 0);
                depth = depth.saturating_add(1);
            }
        } else {
            let Some(above) = depth.checked_sub(1) else { return };
            depth = above;
            let robot = chosen.get(depth).copied().unwrap_or(0);
            (taken, next) = (taken & !bit(robot), robot.saturating_add(1));
        }
    }
}
