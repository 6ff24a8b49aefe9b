//! The roots of what only reads or converts: each alone is small, together they are half of the
//! operations of core.

use crate::on_time::watched;
use cotama_core::allocation::{Allocator, Answer, MemoryError, Shortfall};
use cotama_core::exact::{Exact, Item, Seen, Stage};
use cotama_core::executive::{
    Executive, Latest, Overruns, ScheduleError, Task, TaskError, TaskSet,
};
use cotama_core::front::FrontPlans;
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{AmountError, Monitor};
use cotama_core::net::Ignored;
use cotama_core::player::{Advanced, Outcome};
use cotama_core::problem::Problem;
use cotama_core::team::{Cost, Costs, Fixed, Team};
use cotama_core::units::{Micros, Millis};
use cotama_models::nets::{charger, door};

const A: usize = 2;
const N: usize = 8;

#[unsafe(no_mangle)]
fn root_shortfall_new(axis: usize, limit: u64, least: u64) -> Option<Shortfall> {
    Shortfall::new(axis, limit, least)
}

#[unsafe(no_mangle)]
fn root_read_shortfall(of: &Shortfall) -> [u64; 4] {
    [of.axis() as u64, of.limit(), of.least(), of.gap()]
}

#[unsafe(no_mangle)]
fn root_read_problem(of: Problem<'_, A>, limits: [u64; A]) -> (bool, usize, [usize; A]) {
    let other = of.with_limits(limits);
    (other.within_limits(&of.limits()), other.activities().len(), of.order())
}

#[unsafe(no_mangle)]
fn root_exact_with_memory(
    items: &mut [Item<A>],
    stages: &mut [Stage<A>],
    seen: &mut [Seen<A>],
    problem: &Problem<'_, A>,
    plan: &mut [u16],
) -> Result<Answer<A>, MemoryError> {
    Exact::new(&[], u64::MAX, items, stages).with_memory(seen).allocate(problem, plan)
}

#[unsafe(no_mangle)]
fn root_read_front(plans: &FrontPlans<'_, A>, at: usize) -> (usize, bool, Option<([u64; A], u64)>) {
    (plans.len(), plans.is_empty(), plans.totals(at))
}

#[unsafe(no_mangle)]
fn root_read_hardware(of: Equipment, kind: usize) -> (u8, u64) {
    (of.of(kind), of.to_bits())
}

#[unsafe(no_mangle)]
fn root_read_monitor(
    monitor: &mut Monitor<A>,
    way: &[u64; A],
) -> Result<([i64; A], [u64; A]), AmountError> {
    monitor.hardware_returned();
    Ok((monitor.return_margin(way)?, monitor.used()))
}

#[unsafe(no_mangle)]
fn root_read_latest(of: &mut Latest<u32>, now: Micros, oldest: Micros) -> Option<u32> {
    let read = of.read_within(now, oldest).copied();
    *of = Latest::empty();
    read
}

#[unsafe(no_mangle)]
fn root_read_executive(
    of: &Executive<N>,
    task: usize,
) -> (Micros, Option<u8>, Option<Micros>, Option<bool>, Micros) {
    let budget = of.tasks().get(task).map_or(Micros(0), |it| it.budget());
    (of.now(), of.misses(task), of.used(task), of.is_active(task), budget)
}

#[unsafe(no_mangle)]
fn root_read_fault(happening: &cotama_core::executive::Happening) -> bool {
    happening.rt_fault()
}

#[unsafe(no_mangle)]
fn root_response_times(
    tasks: &[Task],
    overruns: Overruns,
    task: usize,
    iterations: u32,
) -> Result<Option<Result<Micros, ScheduleError>>, TaskError> {
    let set = TaskSet::new(tasks)?.with_iterations(iterations);
    Ok(set.response_times(overruns).nth(task.min(set.tasks().len())))
}

#[unsafe(no_mangle)]
fn root_read_costs(of: Costs<'_>, limit: Cost, row: usize, column: usize) -> Option<u32> {
    let below = of.below(limit);
    let within = row < below.rows() && column < below.columns();
    below.cost(row, column).filter(|_| within).map(|it| it.get())
}

#[unsafe(no_mangle)]
fn root_read_team(of: &Team<'_>) -> (u32, u64, [usize; 4]) {
    let counts = [of.robots(), of.tasks().len(), of.plans(), of.roles()];
    (of.denominator(), of.most(), counts)
}

#[unsafe(no_mangle)]
fn root_read_guard(ignored: &Ignored<'_>, tokens: &[u32]) -> bool {
    ignored.holds(|place| tokens.get(place.0 as usize).copied().unwrap_or(0))
}

#[unsafe(no_mangle)]
fn root_player_without_observer(
    player: &mut door::Player,
    now: Millis,
    event: &door::Event,
) -> (Outcome<door::Transition>, Advanced, bool, Millis, u64) {
    let outcome = player.offer(now, event);
    let advanced = player.advance(now);
    let _ = player.program();
    (outcome, advanced, player.round_is_due(), player.now(), player.marking()[0])
}

#[unsafe(no_mangle)]
fn root_read_firing(
    of: &door::Firing<'_>,
    output: door::Output,
    of_system: &watched::Firing<'_>,
    other: watched::Output,
) -> [bool; 2] {
    [of.says(output), of_system.says(other)]
}

#[unsafe(no_mangle)]
fn root_read_state(of: &watched::Player, component: u16) -> charger::State {
    of.state_of::<charger::Program>(component)
}

#[unsafe(no_mangle)]
fn root_read_fixed(of: &mut Fixed<i32, N, N>, row: usize) -> (Option<usize>, bool) {
    let memory = of.memory();
    (memory.column(row), memory.in_conflict(row))
}
