//! The roots of teams: assignments in both widths, for tables and memory of any size; all tasks at
//! once; and what the thesis does.
//!
//! What is `open` adds prices that only a loaded team keeps small.

use cotama_core::allocation::MemoryError;
use cotama_core::team::joint::{Joint, JointMemory, Solved};
use cotama_core::team::thesis::{Formed, Rounds, Shares, State};
use cotama_core::team::{
    Bottleneck, Coalition, Cost, Costs, Fixed, Flaw, Memory, Plan, RobotSet, Task, Team, TeamError,
    Unassigned, assign, bottleneck, coalition, conflict, is_least, thesis,
};

/// Robots of a team.
const N: usize = 8;

#[unsafe(no_mangle)]
fn root_team_costs(
    entries: &[Option<Cost>],
    columns: usize,
    most: u32,
) -> Option<(u32, Option<Cost>)> {
    let costs = Costs::new(entries, columns)?.at_most(Cost::new(most)?);
    Some((costs.most(), costs.row(0).flatten().min()))
}

#[unsafe(no_mangle)]
fn root_team_memory(
    size: (usize, usize),
    words: &mut [u32],
    amounts: &mut [i32],
) -> Result<Option<usize>, MemoryError> {
    Memory::new(size.0, size.1, words, amounts).map(|it| it.column(0))
}

#[unsafe(no_mangle)]
fn root_team_assign_narrow(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, i32>,
) -> Result<u64, Unassigned> {
    assign(costs, memory)
}

#[unsafe(no_mangle)]
fn root_team_assign_wide(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, i64>,
) -> Result<u64, Unassigned> {
    assign(costs, memory)
}

#[unsafe(no_mangle)]
fn root_team_bottleneck(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, i32>,
) -> Result<Bottleneck, Unassigned> {
    bottleneck(costs, memory)
}

#[unsafe(no_mangle)]
fn root_team_coalition(
    task: &Task<'_>,
    denominator: u32,
    memory: &mut Memory<'_, i32>,
) -> Result<Coalition, Unassigned> {
    coalition(task, denominator, memory)
}

#[unsafe(no_mangle)]
fn root_team_is_least(costs: &Costs<'_>, memory: &Memory<'_, i64>) -> Result<u64, Flaw> {
    is_least(costs, |row| memory.column(row), |column| memory.price(column))
}

#[unsafe(no_mangle)]
fn root_team_conflict(costs: &Costs<'_>, memory: &Memory<'_, i64>) -> (usize, usize) {
    conflict(costs, |row| memory.in_conflict(row))
}

#[unsafe(no_mangle)]
fn root_team_new<'a>(
    robots: usize,
    denominator: u32,
    tasks: &'a [Task<'a>],
) -> Result<Team<'a>, TeamError> {
    Team::new(robots, denominator, tasks)
}

#[unsafe(no_mangle)]
fn root_team_joint(
    team: &Team<'_>,
    memory: JointMemory<'_, N>,
    steps: u64,
) -> Result<Solved, MemoryError> {
    Joint::new(memory).solve(team, steps)
}

#[unsafe(no_mangle)]
fn root_team_all_coalitions(
    task: &Task<'_>,
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i32>,
) -> Formed {
    thesis::all_coalitions(task, 1, entries, memory)
}

#[unsafe(no_mangle)]
fn root_team_all_orderings(task: &Task<'_>, chosen: &mut [usize]) -> Formed {
    thesis::all_orderings(task, 1, chosen)
}

#[unsafe(no_mangle)]
fn root_team_greedy(
    team: &Team<'_>,
    states: &mut [State],
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i64>,
) -> Result<Rounds, Unassigned> {
    thesis::greedy(team, states, entries, memory)
}

#[unsafe(no_mangle)]
fn root_team_shares(shares: &mut Shares<N>) -> Option<(RobotSet, usize)> {
    shares.next()
}

#[unsafe(no_mangle)]
fn root_team_pruning(
    roles: &[&[u64]],
    robots: &[u64],
    entries: &mut [Option<Cost>],
    memory: &mut Memory<'_, i32>,
) -> Option<bool> {
    let first = thesis::has_union(roles, robots) && thesis::has_roles(roles, robots);
    Some(first && thesis::has_matching(roles, robots, entries, memory)?)
}

#[unsafe(no_mangle)]
fn root_team_cost(task: &Task<'_>, plan: &Plan<'_>, denominator: u32, roles: &[Cost]) -> u64 {
    task.cost(plan, denominator, roles.iter().copied())
}

#[unsafe(no_mangle)]
fn root_team_joint_read(
    joint: &mut Joint<'_, N>,
    task: usize,
) -> (Option<(usize, RobotSet)>, Option<usize>, bool) {
    let first = joint.robots(task).next();
    (joint.chosen(task), first, joint.in_conflict(task))
}

#[unsafe(no_mangle)]
fn root_team_fixed() -> (Fixed<i64, N, N>, Shares<N>) {
    (Fixed::new(), Shares::new())
}

#[unsafe(no_mangle)]
fn root_team_memory_read(
    memory: &Memory<'_, i32>,
    column: usize,
    size: (usize, usize),
) -> (Option<usize>, [usize; 2]) {
    let sizes = [Memory::<i32>::words(size.0, size.1), Memory::<i32>::amounts(size.1)];
    (memory.row(column), sizes)
}
