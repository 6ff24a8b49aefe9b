//! Greedy rounds: task after task (3.4.4, Algorithm 3.1).

use super::{bit, only};
use cotama_core::allocation::MemoryError;
use cotama_core::team::Memory;
use cotama_core::team::coalition;
use cotama_core::team::{AssignmentError, assign};
use cotama_core::team::{Cost, Costs};
use cotama_core::team::{Plan, Task};
use cotama_core::team::{RobotSet, Team};

/// The outcome of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Nobody has been asked yet.
    Open,
    /// The task is left undone.
    Undone,
    /// The task is done by this plan and these robots.
    Done {
        /// The plan.
        plan: usize,
        /// The robots.
        robots: RobotSet,
    },
}

/// How greedy rounds end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rounds {
    /// Cost of the tasks that are done, and of leaving the others undone; those that must be done
    /// and are not cost nothing.
    pub cost: u64,
    /// How many tasks that must be done are not.
    pub unserved: usize,
    /// How many rounds there were.
    pub rounds: usize,
}

/// Announces the task of several robots with the largest utility a robot (3.7), if that is more
/// than the mean utility of the tasks of one robot, else all of these (3.8); whoever is chosen is
/// taken; and so on. How the costs of roles become one is optimised exactly, and what is cheaper
/// left undone is. A task that must be done has four times the largest cost as its utility.
///
/// `states` has one element a task, `entries` room for the roles of the largest plan times robots,
/// and for open tasks of one robot times these and robots; `memory` for the same tables.
///
/// # Errors
/// [`AssignmentError::Memory`] where memory lacks.
pub fn greedy(
    team: &Team<'_>,
    states: &mut [State],
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i64>,
) -> Result<Rounds, AssignmentError> {
    let lacks = MemoryError { what: "greedy rounds", needed: team.tasks().len(), given: 0 };
    let states = states.get_mut(..team.tasks().len()).ok_or(lacks)?;
    states.fill(State::Open);
    let most = |task: &Task<'_>| task.plans.iter().map(|it| it.roles.most()).max().unwrap_or(0);
    let most = team.tasks().iter().map(most).max().unwrap_or(0).saturating_mul(4);
    let (mut free, mut rounds) = (bit(team.robots()).wrapping_sub(1), 0_usize);
    if team.robots() == Team::MAX_ROBOTS {
        free = RobotSet::MAX;
    }
    let utility = |task: &Task<'_>| u64::from(task.skip.map_or(most, Cost::get));
    while let Some(next) = announced(team, states, utility) {
        rounds = rounds.saturating_add(1);
        match next {
            Announced::Several(task) => {
                let state = several(team, task, free, utility, entries, memory)?;
                if let State::Done { robots, .. } = state {
                    free &= !robots;
                }
                if let Some(it) = states.get_mut(task) {
                    *it = state;
                }
            }
            Announced::Singles => free = singles(team, states, free, utility, entries, memory)?,
        }
    }
    let mut result = Rounds { cost: 0, unserved: 0, rounds };
    for (task, state) in team.tasks().iter().zip(states.iter()) {
        match (state, task.skip) {
            (State::Done { plan, robots }, _) => {
                let cost = staffed(team, task, *plan, *robots, entries, memory)?;
                result.cost = result.cost.saturating_add(cost.unwrap_or(0));
            }
            (_, Some(skip)) => {
                let skip = u64::from(team.denominator()).saturating_mul(skip.get().into());
                result.cost = result.cost.saturating_add(skip);
            }
            (_, None) => result.unserved = result.unserved.saturating_add(1),
        }
    }
    Ok(result)
}

/// Whether a task has a plan of several roles.
fn is_several(task: &Task<'_>) -> bool {
    task.plans.iter().any(|it| it.roles.rows() > 1)
}

/// The tasks announced in a round.
enum Announced {
    /// This task of several robots.
    Several(usize),
    /// All open tasks of one robot.
    Singles,
}

/// The task of several robots that is announced, or all those of one; none where nothing is open.
fn announced(
    team: &Team<'_>,
    states: &[State],
    utility: impl Fn(&Task<'_>) -> u64,
) -> Option<Announced> {
    let tasks = || (0..team.tasks().len()).zip(team.tasks()).zip(states);
    let open = || tasks().filter(|it| *it.1 == State::Open).map(|it| it.0);
    let singles = || open().filter(|it| !is_several(it.1));
    // Utility over mean plan size, as utility times plans over roles.
    let mut best: Option<(u128, u128, usize)> = None;
    for (number, task) in open().filter(|it| is_several(it.1)) {
        let over = u128::from(utility(task)).saturating_mul(task.plans.len() as u128);
        let under =
            task.plans.iter().map(|it| it.roles.rows() as u128).fold(0, u128::saturating_add);
        let better =
            |it: (u128, u128, usize)| over.saturating_mul(it.1) > it.0.saturating_mul(under);
        if best.is_none_or(better) {
            best = Some((over, under, number));
        }
    }
    let count = singles().fold(0_u128, |count, _| count.wrapping_add(1));
    let Some((over, under, task)) = best else { return (count > 0).then_some(Announced::Singles) };
    let sum = singles().map(|it| u128::from(utility(it.1))).fold(0, u128::saturating_add);
    let first = count == 0 || over.saturating_mul(count) > sum.saturating_mul(under);
    Some(if first { Announced::Several(task) } else { Announced::Singles })
}

/// Returns the best offer for a task of several robots from the free ones.
fn several(
    team: &Team<'_>,
    number: usize,
    free: RobotSet,
    utility: impl Fn(&Task<'_>) -> u64,
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i64>,
) -> Result<State, AssignmentError> {
    let Some(task) = team.tasks().get(number) else { return Ok(State::Undone) };
    let limit = utility(task).saturating_mul(team.denominator().into());
    let (mut state, mut least) = (State::Undone, limit);
    for (plan, it) in (0..task.plans.len()).zip(task.plans) {
        let Some((cost, robots)) = best(team, task, it, free, entries, memory)? else { continue };
        if cost < least {
            (state, least) = (State::Done { plan, robots }, cost);
        }
    }
    Ok(state)
}

/// The best coalition of free robots for one plan.
fn best(
    team: &Team<'_>,
    task: &Task<'_>,
    plan: &Plan<'_>,
    free: RobotSet,
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i64>,
) -> Result<Option<(u64, RobotSet)>, AssignmentError> {
    let roles = plan.roles.rows();
    let needed = roles.saturating_mul(free.count_ones() as usize);
    let lacks = MemoryError { what: "entries of greedy rounds", needed, given: entries.len() };
    if roles > free.count_ones() as usize {
        return Ok(None);
    }
    let roles = only(&plan.roles, free, entries).ok_or(lacks)?;
    let plans = [Plan { roles, extra: plan.extra }];
    let own = Task { plans: &plans, ..*task };
    let found = match coalition(&own, team.denominator(), memory) {
        Ok(found) => found,
        Err(AssignmentError::Infeasible { .. }) => return Ok(None),
        Err(error) => return Err(error),
    };
    let robot = |role| nth(free, memory.column(role)?);
    let robots = (0..plan.roles.rows()).filter_map(robot).fold(0, |set, it| set | bit(it));
    Ok(Some((found.cost, robots)))
}

/// Returns the cost of a task by this plan with these robots.
fn staffed(
    team: &Team<'_>,
    task: &Task<'_>,
    plan: usize,
    robots: RobotSet,
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i64>,
) -> Result<Option<u64>, AssignmentError> {
    let Some(plan) = task.plans.get(plan) else { return Ok(None) };
    Ok(best(team, task, plan, robots, entries, memory)?.map(|it| it.0))
}

/// The element of a set with so many before it.
fn nth(set: RobotSet, place: usize) -> Option<usize> {
    (0..Team::MAX_ROBOTS).filter(|it| set & bit(*it) != 0).nth(place)
}

/// Assigns all open tasks of one robot at once (3.2), each with a placeholder of its own that
/// leaves it undone; the robots that are left.
fn singles(
    team: &Team<'_>,
    states: &mut [State],
    free: RobotSet,
    utility: impl Fn(&Task<'_>) -> u64,
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i64>,
) -> Result<RobotSet, AssignmentError> {
    let count = states.iter().zip(team.tasks());
    let count = count.filter(|it| *it.0 == State::Open && !is_several(it.1));
    let count = count.fold(0_usize, |count, _| count.wrapping_add(1));
    let width = (free.count_ones() as usize).saturating_add(count);
    let needed = width.saturating_mul(count);
    let lacks = MemoryError { what: "entries of greedy rounds", needed, given: entries.len() };
    let entries = entries.get_mut(..needed).ok_or(lacks)?;
    entries.fill(None);
    let is_open = |it: &(&mut State, &Task<'_>)| *it.0 == State::Open && !is_several(it.1);
    let mut left = free;
    let open = states.iter_mut().zip(team.tasks()).filter(is_open);
    for (number, (_, task)) in (0..count).zip(open) {
        let from = number.wrapping_mul(width);
        let row = entries.get_mut(from..from.wrapping_add(width)).unwrap_or_default();
        for (robot, entry) in
            (0..team.robots()).filter(|it| free & bit(*it) != 0).zip(row.iter_mut())
        {
            *entry = cheapest(task, robot).map(|it| it.1);
        }
        let placeholder = width.saturating_sub(count).saturating_add(number);
        if let Some(entry) = row.get_mut(placeholder) {
            *entry = Cost::new(utility(task).min(Cost::MOST.into()) as u32);
        }
    }
    let costs = Costs::new(entries, width).ok_or(lacks)?;
    assign(&costs, memory)?;
    let open = states.iter_mut().zip(team.tasks()).filter(is_open);
    for (number, (state, task)) in (0..count).zip(open) {
        let robot = memory.column(number).and_then(|it| nth(free, it));
        *state = match robot.and_then(|it| Some((it, cheapest(task, it)?.0))) {
            Some((robot, plan)) => {
                left &= !bit(robot);
                State::Done { plan, robots: bit(robot) }
            }
            None => State::Undone,
        };
    }
    Ok(left)
}

/// The cheapest plan of a task of one robot for this one, and what it costs.
fn cheapest(task: &Task<'_>, robot: usize) -> Option<(usize, Cost)> {
    let cost = |(number, plan): (usize, &Plan<'_>)| {
        let cost = plan.roles.cost(0, robot)?.get().saturating_add(plan.extra);
        Some((number, Cost::new(cost)?))
    };
    (0..task.plans.len()).zip(task.plans).filter_map(cost).min_by_key(|it| it.1)
}
