//! The roots of the rest of core: allocators, front, monitor, problems and hardware, for the
//! patrol's two axes.
//!
//! Every list is the caller's, of any length and with anything in it.

use cotama_core::allocation::{Allocator, Answer, MemoryError};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::front::{Front, Node};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{AmountError, Monitor, Request, Upward, worst};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem, ProblemError};

/// Two axes: duration and energy.
const A: usize = 2;

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_` or `open_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_problem_new<'a>(
    activities: &'a [&'a [Candidate<A>]],
    limits: [u64; A],
    order: [usize; A],
) -> Result<Problem<'a, A>, ProblemError> {
    Problem::new(activities, limits, order)
}

#[unsafe(no_mangle)]
fn root_problem_totals(problem: &Problem<'_, A>, plan: &[u16]) -> Option<([u64; A], u64)> {
    problem.totals(plan)
}

#[unsafe(no_mangle)]
fn root_problem_least(problem: &Problem<'_, A>, axis: usize) -> u64 {
    problem.least(axis)
}

#[unsafe(no_mangle)]
fn root_problem_combinations(problem: &Problem<'_, A>) -> Option<u128> {
    problem.combinations()
}

#[unsafe(no_mangle)]
fn root_panorama_allocate(
    caps: &mut [[u32; A]],
    problem: &Problem<'_, A>,
    plan: &mut [u16],
) -> Result<Answer<A>, MemoryError> {
    Panorama::new(caps).allocate(problem, plan)
}

#[unsafe(no_mangle)]
fn root_exact_allocate(
    objectives: &[Objective],
    steps: u64,
    items: &mut [Item<A>],
    stages: &mut [Stage<A>],
    problem: &Problem<'_, A>,
    plan: &mut [u16],
) -> Result<Answer<A>, MemoryError> {
    Exact::new(objectives, steps, items, stages).allocate(problem, plan)
}

#[unsafe(no_mangle)]
fn root_front_find(
    nodes: &mut [Node<A>],
    problem: &Problem<'_, A>,
    at: usize,
    plan: &mut [u16],
) -> bool {
    Front::new(nodes)
        .find(problem)
        .is_ok_and(|plans| plans.totals(at).is_some() && plans.plan(at, plan))
}

#[unsafe(no_mangle)]
fn root_monitor_new(limits: [u64; A], order: [usize; A], upward: Upward<A>) -> Option<Monitor<A>> {
    Some(Monitor::new(limits, order).ok()?.with_upward(upward))
}

#[unsafe(no_mangle)]
fn root_monitor_planned(monitor: &mut Monitor<A>, rest: &[u64; A]) -> Result<(), AmountError> {
    monitor.planned(rest)
}

#[unsafe(no_mangle)]
fn root_monitor_spend(monitor: &mut Monitor<A>, cost: &[u64; A]) -> Result<(), AmountError> {
    monitor.spend(cost)
}

#[unsafe(no_mangle)]
fn root_monitor_assess(
    monitor: &Monitor<A>,
    rest: &[u64; A],
    needs: Equipment,
    available: Equipment,
) -> Result<Request, AmountError> {
    monitor.assess(rest, needs, available)
}

#[unsafe(no_mangle)]
fn root_monitor_margins(monitor: &Monitor<A>, rest: &[u64; A]) -> Result<[i64; A], AmountError> {
    monitor.margins(rest)
}

#[unsafe(no_mangle)]
fn root_monitor_room(monitor: &Monitor<A>) -> ([u64; A], [u64; A]) {
    (monitor.left(), monitor.room())
}

#[unsafe(no_mangle)]
fn root_monitor_worst(activities: &[&[Candidate<A>]]) -> [u64; A] {
    worst(activities)
}

#[unsafe(no_mangle)]
fn root_hardware_units(bits: u64, kind: usize, count: u8) -> Option<Equipment> {
    let units = Equipment::from_bits(bits)?.with(kind, count)?;
    Some(units.without(kind, count).union(units))
}

#[unsafe(no_mangle)]
fn root_hardware_covers(available: Equipment, needs: Equipment) -> bool {
    available.covers(needs)
}
