//! One plan of the patrol with each allocator, and a hard mission of its size, each in a function
//! of its own for an instruction count; and the bytes of the patrol's memory.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Seen, Stage, Workspace};
use cotama_core::panorama::Panorama;
use cotama_core::problem::Problem;
use cotama_models::missions::tables::buffer_sizes;
use cotama_models::missions::tables::patrol::ACTIVITIES;
use cotama_tests::instances::{Instance, random_mission};
use std::hint::black_box;

const STAGES: usize = ACTIVITIES.len();
const CANDIDATES: usize = buffer_sizes(&ACTIVITIES).0;
const SEEN: usize = 64;
/// All memory that the exact plan of the patrol works in.
const EXACT_BYTES: usize = CANDIDATES * size_of::<Item<2>>()
    + STAGES * size_of::<Stage<2>>()
    + SEEN * size_of::<Seen<2>>();
const _: () = assert!(EXACT_BYTES < 12 * 1024);

#[inline(never)]
fn exact_patrol(problem: &Problem<'_, 2>, plan: &mut [u16]) -> Option<u64> {
    let (mut items, mut stages, mut seen) =
        ([Item::EMPTY; CANDIDATES], [Stage::EMPTY; STAGES], [Seen::EMPTY; SEEN]);
    let exact = Exact::new(&[Objective::MostQuality], u64::MAX, &mut items, &mut stages);
    match exact.with_memory(&mut seen).allocate(problem, plan) {
        Ok(Answer::Planned(planned)) => Some(planned.steps),
        _ => None,
    }
}

/// One of the random missions of 17 activities that use nearly all of the promised 100,000 steps.
#[inline(never)]
fn exact_hard(instance: &Instance<2>, plan: &mut [u16]) -> Option<u64> {
    let slices = instance.slices();
    let problem = instance.problem(&slices);
    let mut workspace = Workspace::new();
    let mut exact = workspace.exact(&problem, &[Objective::MostQuality], 100_000, 4096);
    match exact.allocate(&problem, plan) {
        Ok(Answer::Planned(planned)) => Some(planned.steps),
        _ => None,
    }
}

#[inline(never)]
fn panorama_patrol(problem: &Problem<'_, 2>, plan: &mut [u16]) -> Option<u64> {
    let mut caps = [[0; 2]; 17];
    match Panorama::new(&mut caps).allocate(problem, plan) {
        Ok(Answer::Planned(planned)) => Some(planned.steps),
        _ => None,
    }
}

fn main() {
    cotama_tests::with_patrol(|problem| {
        let mut plan = [0; 17];
        let steps = exact_patrol(black_box(problem), &mut plan);
        println!("exact: {steps:?} steps in {EXACT_BYTES} bytes, {plan:?}");
        let hard = random_mission(4_743);
        println!("hard: {:?} steps, {plan:?}", exact_hard(black_box(&hard), &mut plan));
        println!("panorama: {:?} steps, {plan:?}", panorama_patrol(black_box(problem), &mut plan));
    });
}
