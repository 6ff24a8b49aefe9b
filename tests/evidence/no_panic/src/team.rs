//! The roots of teams: assignments in both widths, for tables and memory of any size; and all tasks
//! at once.
//!
//! What is `open` adds prices that only a loaded team keeps small.

use cotama_core::allocation::MemoryError;
use cotama_core::team::winners::{Solved, Winners, WinnersMemory};
use cotama_core::team::{
    AssignmentError, Bottleneck, Coalition, Cost, Costs, Fixed, Memory, Plan, ProofError, RobotSet,
    Task, Team, TeamError, assign, bottleneck, coalition, conflict, is_least,
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
) -> Result<u64, AssignmentError> {
    assign(costs, memory)
}

#[unsafe(no_mangle)]
fn root_team_assign_wide(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, i64>,
) -> Result<u64, AssignmentError> {
    assign(costs, memory)
}

#[unsafe(no_mangle)]
fn root_team_bottleneck(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, i32>,
) -> Result<Bottleneck, AssignmentError> {
    bottleneck(costs, memory)
}

#[unsafe(no_mangle)]
fn root_team_coalition(
    task: &Task<'_>,
    denominator: u32,
    memory: &mut Memory<'_, i32>,
) -> Result<Coalition, AssignmentError> {
    coalition(task, denominator, memory)
}

#[unsafe(no_mangle)]
fn root_team_is_least(costs: &Costs<'_>, memory: &Memory<'_, i64>) -> Result<u64, ProofError> {
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
    memory: WinnersMemory<'_, N>,
    steps: u64,
) -> Result<Solved, MemoryError> {
    Winners::new(memory).solve(team, steps)
}

#[unsafe(no_mangle)]
fn root_team_cost(task: &Task<'_>, plan: &Plan<'_>, denominator: u32, roles: &[Cost]) -> u64 {
    task.cost(plan, denominator, roles.iter().copied())
}

#[unsafe(no_mangle)]
fn root_team_joint_read(
    joint: &mut Winners<'_, N>,
    task: usize,
) -> (Option<(usize, RobotSet)>, Option<usize>, bool) {
    let first = joint.robots(task).next();
    (joint.chosen(task), first, joint.in_conflict(task))
}

#[unsafe(no_mangle)]
fn root_team_fixed() -> Fixed<i64, N, N> {
    Fixed::new()
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
