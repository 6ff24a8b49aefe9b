//! The core as firmware links it: allocators, front and monitor on the tables of the patrol, teams
//! of eight robots, the decisional level of the delivery, and queries of two networks.
//!
//! This crate has a panic handler, so it does not build when anything below it needs `std`, and no
//! global allocator, so it does not build when anything below it needs the heap. `check.sh` builds
//! it, builds the canaries that must fail, and prints the size of each entry point on the target.
#![no_std]
#![deny(missing_docs)]

#[cfg(feature = "canary-alloc")]
extern crate alloc;
#[cfg(feature = "canary-std")]
extern crate std;

mod asia;
mod two_ways;

use core::panic::PanicInfo;
use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::front::{Front, Node};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{Monitor, Request};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};
use cotama_core::team::winners::{
    Column, Level, Open, Outcome, PlanEntry, Slot, Winners, WinnersMemory,
};
use cotama_core::team::{Combine, Cost, Costs, Fixed, Plan as TaskPlan, Task, Team, assign};
use cotama_core::units::{Millimetres, Millis};
use cotama_inference::Query;
use cotama_models::level::{Drive, Perceived, Told};
use cotama_models::missions::tables::patrol::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, remaining};
use cotama_printed::{Careful, Decider, at_rest};

const STAGES: usize = ACTIVITIES.len();
const CANDIDATES: usize = buffer_sizes(&ACTIVITIES).0;
/// Partial plans kept for the front: enough for the last activities of the patrol.
const NODES: usize = 256;

/// A plan of the patrol: the alternative of each activity.
pub type Plan = [u16; STAGES];

/// The patrol from one of its activities on, of which `left` is left; `None` when nothing can be
/// planned.
fn with_rest<R>(
    first: usize,
    left: u64,
    act: impl FnOnce(&Problem<'_, 2>) -> Option<R>,
) -> Option<R> {
    let mut candidates: [Candidate<2>; CANDIDATES] = [EMPTY; CANDIDATES];
    let mut lists = [&[][..]; STAGES];
    let rest = Rest::Travel(Millimetres(left));
    let activities =
        remaining(ACTIVITIES.get(first..)?, Some(rest), AVAILABLE, &mut candidates, &mut lists)
            .ok()?;
    act(&Problem::new(activities, LIMITS, ORDER).ok()?)
}

/// The quality of the plan that an allocator finds.
fn quality(
    allocator: &mut impl Allocator<2>,
    problem: &Problem<'_, 2>,
    plan: &mut Plan,
) -> Option<u64> {
    match allocator.allocate(problem, plan) {
        Ok(Answer::Planned(planned)) => Some(planned.quality),
        Ok(Answer::Infeasible { .. } | Answer::Unknown { .. }) | Err(_) => None,
    }
}

// The entry points. `no_mangle` counts as unsafe because two equal names would meet at link time:
// these begin with `cotama_`, as no symbol of `core` does. Without it a static library keeps no
// function at all.

/// Plans with the paper's rule; the quality, or zero without a plan.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_panorama(first: usize, left: u64, plan: &mut Plan) -> u64 {
    let mut caps = [[0; 2]; STAGES];
    let mut allocator = Panorama::new(&mut caps);
    with_rest(first, left, |problem| quality(&mut allocator, problem, plan)).unwrap_or(0)
}

/// Plans with the complete allocator within a number of steps; the quality, or zero without a plan.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_exact(first: usize, left: u64, steps: u64, plan: &mut Plan) -> u64 {
    let (mut items, mut stages) = ([Item::EMPTY; CANDIDATES], [Stage::EMPTY; STAGES]);
    let objectives = [Objective::MostQuality, Objective::Least(1)];
    let mut allocator = Exact::new(&objectives, steps, &mut items, &mut stages);
    with_rest(first, left, |problem| quality(&mut allocator, problem, plan)).unwrap_or(0)
}

/// The number of undominated plans, and the first of them; zero when memory or plans lack.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_front(first: usize, left: u64, plan: &mut Plan) -> usize {
    let mut nodes = [Node::EMPTY; NODES];
    with_rest(first, left, |problem| {
        let mut front = Front::new(&mut nodes);
        let plans = front.find(problem).ok()?;
        plans.plan(0, plan).then(|| plans.len())
    })
    .unwrap_or(0)
}

/// Whether a plan still holds after this consumption with this hardware: 0 yes, 1 no, 2 there may
/// be a better one, 3 an amount is out of range.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_monitor(
    used: &[u64; 2],
    rest: &[u64; 2],
    needs: u64,
    available: u64,
) -> u32 {
    let assess = || {
        let mut monitor = Monitor::new(LIMITS, ORDER).ok()?;
        monitor.planned(&LIMITS).ok()?;
        monitor.spend(used).ok()?;
        monitor.assess(rest, Equipment::from_bits(needs)?, Equipment::from_bits(available)?).ok()
    };
    match assess() {
        Some(Request::Keep) => 0,
        Some(Request::Down(_)) => 1,
        Some(Request::Up) => 2,
        None => 3,
    }
}

/// Assigns eight roles to eight robots; the least sum, or the largest number without one.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_assign(costs: &[u32; 64], robots: &mut [u8; 8]) -> u64 {
    let entries = costs.map(Cost::new);
    let mut fixed = Fixed::<i32, 8, 8>::new();
    let mut memory = fixed.memory();
    let total = Costs::new(&entries, 8).and_then(|it| assign(&it, &mut memory).ok());
    for (role, robot) in robots.iter_mut().enumerate() {
        *robot = memory.column(role).unwrap_or(8) as u8;
    }
    total.unwrap_or(u64::MAX)
}

/// Assigns four tasks of two roles each to eight robots at once; the least cost, or the largest
/// number where it is not known.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_team(costs: &[[u32; 16]; 4], steps: u64, taken: &mut [u8; 4]) -> u64 {
    let entries = costs.map(|it| it.map(Cost::new));
    let mut solve = || {
        let [a, b, c, d] = &entries;
        let plan = |it| Some([TaskPlan { roles: Costs::new(it, 8)?, extra: 0 }]);
        let plans = [plan(a)?, plan(b)?, plan(c)?, plan(d)?];
        let tasks =
            plans.each_ref().map(|it| Task { skip: None, combine: Combine::Sum, plans: it });
        let team = Team::new(8, 1, &tasks).ok()?;
        let (mut roles, mut plans, mut slots) =
            ([[0; 8]; 8], [PlanEntry::EMPTY; 4], [Slot::EMPTY; 4]);
        let (mut columns, mut open) = ([Column::EMPTY; 256], [Open::EMPTY; 16]);
        let mut levels = [Level::EMPTY; 9];
        let mut joint = Winners::<8>::new(WinnersMemory {
            roles: &mut roles,
            plans: &mut plans,
            slots: &mut slots,
            columns: &mut columns,
            open: &mut open,
            levels: &mut levels,
        });
        let Outcome::Optimal { cost } = joint.solve(&team, steps).ok()?.outcome else {
            return None;
        };
        for (task, taken) in taken.iter_mut().enumerate() {
            *taken = joint.chosen(task).map_or(0, |it| it.1 as u8);
        }
        Some(cost)
    };
    solve().unwrap_or(u64::MAX)
}

/// Begins the delivery, and shows these flags in its second period; the fastest that the robot may
/// go after so many, in mm/s.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_level(raised: u64, works: u64, periods: u64) -> u64 {
    let mut decider = Decider::new(at_rest(Careful::default()));
    let mut speed = 0;
    for number in 0..periods {
        let now = Millis(number.saturating_mul(100));
        let raised = if number == 1 { raised } else { 0 };
        decider.perceive(now, Perceived { raised, lowered: 0, works });
        let said = (number == 0).then_some(Told::Begins);
        let drive = Drive { at_goal: false, stands: false };
        let _ = decider.period(now, said, drive, &mut ());
        speed = decider.requests(now).speed.0;
    }
    speed
}

/// The probability of lung cancer, in units of 2⁻³⁰, given two findings.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_asia(evidence: &[u8; 2]) -> u32 {
    answer::<{ asia::QUERY.scratch }, 2>(&asia::QUERY, evidence)
}

/// The probability of the first ratio of objects on two ways, in units of 2⁻³⁰, given a trial.
#[unsafe(no_mangle)]
pub extern "C" fn cotama_two_ways(evidence: &[u8; 4]) -> u32 {
    answer::<{ two_ways::QUERY.scratch }, 5>(&two_ways::QUERY, evidence)
}

fn answer<const CELLS: usize, const STATES: usize>(query: &Query<'_>, evidence: &[u8]) -> u32 {
    let (mut scratch, mut posterior) = ([0; CELLS], [0; STATES]);
    let found = query.answer(evidence, &mut scratch, &mut posterior);
    found.map_or(u32::MAX, |_| posterior.first().copied().unwrap_or(u32::MAX))
}

/// Takes memory from the heap.
#[cfg(feature = "canary-alloc")]
#[unsafe(no_mangle)]
pub extern "C" fn cotama_canary(length: usize) -> usize {
    let mut plan = alloc::vec::Vec::<u16>::new();
    plan.resize(length, 0);
    core::hint::black_box(&plan).len()
}

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
