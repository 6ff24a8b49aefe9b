//! All tasks of a team at once, against all ways to staff them in the smallest teams.

use super::*;
use crate::{Combine, Cost, Costs, Plan, Task, Team};
use cotama_units::proofs::few;

/// The most robots of a team.
const ROBOTS: usize = 3;
/// All costs are counted in halves.
const DENOMINATOR: u32 = 2;

/// Any cost below three, or none.
fn any_entry() -> Option<Cost> {
    Cost::new(u32::from(few::<2>())).filter(|it| it.get() < 3)
}

/// A cost that must be paid, or none.
fn any_skip(cost: u32) -> Option<Cost> {
    if kani::any() { Cost::new(cost) } else { None }
}

/// Returns the cost of a task by a plan with these robots in its roles, in halves; `None` where one
/// of them cannot have its role, or would have two.
fn cost(task: &Task<'_>, plan: &Plan<'_>, robots: &[usize]) -> Option<(RobotSet, u64)> {
    let (mut set, mut sum, mut largest) = (0, 0, 0);
    for (role, robot) in robots.iter().enumerate() {
        let own = u64::from(plan.roles.cost(role, *robot)?.get());
        if set & (1 << robot) != 0 {
            return None;
        }
        (set, sum, largest) = (set | 1 << robot, sum + own, largest.max(own));
    }
    let halves = match task.combine {
        Combine::Sum => 2 * sum,
        Combine::Mean => 2 * sum / robots.len() as u64,
        Combine::Max => 2 * largest,
    };
    Some((set, halves + 2 * u64::from(plan.extra)))
}

/// The least that these tasks cost without the robots that are taken, of all ways to staff them.
fn least(tasks: &[Task<'_>], robots: usize, taken: RobotSet) -> Option<u64> {
    let Some((task, others)) = tasks.split_first() else { return Some(0) };
    let mut best = None;
    let mut offer = |set: RobotSet, cost: u64| {
        if set & taken == 0
            && let Some(rest) = least(others, robots, taken | set)
            && best.is_none_or(|it| it > cost + rest)
        {
            best = Some(cost + rest);
        }
    };
    if let Some(skip) = task.skip {
        offer(0, 2 * u64::from(skip.get()));
    }
    for plan in task.plans {
        let roles = plan.roles.rows();
        let choices = if roles == 1 { robots } else { robots * robots };
        for choice in 0..choices {
            if let Some((set, cost)) =
                cost(task, plan, &[choice % robots, choice / robots][..roles])
            {
                offer(set, cost);
            }
        }
    }
    best
}

/// Returns the cost of the chosen plans with the robots reported for their roles; no robot has two
/// roles, and each task that must be done is done.
fn chosen(winners: &mut Winners<'_, ROBOTS>, tasks: &[Task<'_>]) -> u64 {
    let (mut taken, mut sum): (RobotSet, u64) = (0, 0);
    for (number, task) in tasks.iter().enumerate() {
        let Some((plan, set)) = winners.chosen(number) else {
            let Some(skip) = task.skip else { unreachable!() };
            sum += 2 * u64::from(skip.get());
            continue;
        };
        let (mut robots, mut count) = ([0; 2], 0);
        for robot in winners.robots(number) {
            robots[count] = robot;
            count += 1;
        }
        let plan = &task.plans[plan];
        assert!(count == plan.roles.rows());
        let Some((own, cost)) = cost(task, plan, &robots[..count]) else { unreachable!() };
        assert!(own == set && set & taken == 0);
        (taken, sum) = (taken | set, sum + cost);
    }
    sum
}

/// Solves a team within so many steps, and holds the answer against the least of all ways to staff
/// it; both are given back.
fn solved(tasks: &[Task<'_>; 2], robots: usize, steps: u64) -> (Solved, Option<u64>) {
    let (mut roles, mut plans) = ([[0; ROBOTS]; 4], [PlanEntry::EMPTY; 3]);
    let (mut slots, mut columns) = ([Slot::EMPTY; 2], [Column::EMPTY; 64]);
    let (mut open, mut levels) = ([Open::EMPTY; 2 * ROBOTS], [Level::EMPTY; ROBOTS + 1]);
    let mut winners = Winners::new(WinnersMemory {
        roles: &mut roles,
        plans: &mut plans,
        slots: &mut slots,
        columns: &mut columns,
        open: &mut open,
        levels: &mut levels,
    });
    let Ok(team) = Team::new(robots, DENOMINATOR, tasks) else { unreachable!() };
    let Ok(said) = winners.solve(&team, steps) else { unreachable!() };
    let least = least(tasks, robots, 0);
    assert!(said.steps <= steps);
    match said.outcome {
        Outcome::Optimal { cost } => {
            assert!(least == Some(cost) && chosen(&mut winners, tasks) == cost);
        }
        Outcome::Infeasible { .. } => {
            // So are the tasks in conflict alone.
            let skip =
                |it: usize| if winners.in_conflict(it) { tasks[it].skip } else { Cost::new(0) };
            let alone = [0, 1].map(|it| Task { skip: skip(it), ..tasks[it] });
            assert!(least.is_none() && self::least(&alone, robots, 0).is_none());
        }
        Outcome::Unknown { cost, bound } => {
            assert!(least.is_none_or(|it| bound <= it));
            assert!(cost.is_none_or(|it| chosen(&mut winners, tasks) == it));
        }
    }
    (said, least)
}

/// With steps enough two tasks of three robots, one of which takes two of them, cost the least of
/// all ways to staff them, and no robot has two roles; or those in conflict cannot be staffed.
#[kani::proof]
#[kani::unwind(241)]
pub fn all_tasks_at_once_cost_the_least() {
    let single: [Option<Cost>; 3] = core::array::from_fn(|_| any_entry());
    let dear = |at: usize| Cost::new([1, 0, 2, 2, 1, 0][at]);
    let pair: [Option<Cost>; 6] =
        core::array::from_fn(|at| if kani::any() { dear(at) } else { None });
    let (Some(single), Some(pair)) = (Costs::new(&single, 3), Costs::new(&pair, 3)) else {
        unreachable!()
    };
    let combine = match few::<2>() {
        0 => Combine::Sum,
        1 => Combine::Mean,
        _ => Combine::Max,
    };
    let (two, one) = ([Plan { roles: pair, extra: 0 }], [Plan { roles: single, extra: 0 }]);
    let first = Task { skip: any_skip(3), combine, plans: &two };
    let second = Task { skip: any_skip(2), combine: Combine::Sum, plans: &one };
    let (said, least) = solved(&[first, second], 3, 100_000);
    assert!(!matches!(said.outcome, Outcome::Unknown { .. }));
    let all = first.skip.is_none() && second.skip.is_none();
    kani::cover!(all && least.is_some(), "all three work");
    kani::cover!(said.nodes > 1, "by a search");
    kani::cover!(matches!(said.outcome, Outcome::Infeasible { .. }), "in conflict");
}

/// Whatever the budget of steps, it is kept, the bound is at most the least that two tasks of two
/// robots cost, and a solution costs what is said, with no robot in two roles.
#[kani::proof]
#[kani::unwind(241)]
pub fn the_bound_of_all_tasks_holds_whatever_the_budget() {
    let (pair, other): ([Option<Cost>; 4], [Option<Cost>; 2]) =
        (core::array::from_fn(|_| any_entry()), core::array::from_fn(|_| any_entry()));
    let alone = [Cost::new(2), Cost::new(1)];
    let (Some(pair), Some(alone)) = (Costs::new(&pair, 2), Costs::new(&alone, 2)) else {
        unreachable!()
    };
    let Some(other) = Costs::new(&other, 2) else { unreachable!() };
    let two = [Plan { roles: pair, extra: 0 }, Plan { roles: alone, extra: 1 }];
    let one = [Plan { roles: other, extra: 0 }];
    let first = Task { skip: any_skip(3), combine: Combine::Mean, plans: &two };
    let second = Task { skip: any_skip(2), combine: Combine::Sum, plans: &one };
    let steps = [0, 8, 16, 24, 40, 80, 160, 1_000][usize::from(few::<3>())];
    let (said, least) = solved(&[first, second], 2, steps);
    if let Outcome::Unknown { cost, bound } = said.outcome {
        kani::cover!(cost.is_none() && least.is_some(), "not found in time");
        kani::cover!(cost.is_some() && Some(bound) < least, "not known to be the best");
        kani::cover!(cost == least && Some(bound) == least, "the best, and not known to be");
    }
}
