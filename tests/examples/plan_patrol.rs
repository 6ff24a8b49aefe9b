//! One plan of the patrol with each allocator, each in a function of its own for an instruction count.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Seen, Stage};
use cotama_core::panorama::Panorama;
use cotama_core::problem::Problem;
use std::hint::black_box;

#[inline(never)]
#[allow(clippy::large_stack_arrays)] // as firmware would hold it
fn exact_patrol(problem: &Problem<'_, 2>, plan: &mut [u16]) -> Option<u64> {
    let (mut items, mut stages, mut seen) = ([Item::EMPTY; 17 * 21], [Stage::EMPTY; 17], [Seen::EMPTY; 512]);
    let exact = Exact::new(&[Objective::MostQuality], u64::MAX, &mut items, &mut stages);
    match exact.with_memory(&mut seen).allocate(problem, plan) {
        Ok(Answer::Planned(planned)) => Some(planned.steps),
        _ => None,
    }
}

#[inline(never)]
fn panorama_patrol(problem: &Problem<'_, 2>, plan: &mut [u16]) -> Option<u64> {
    let (mut caps, mut sorted) = ([[0; 2]; 17], [0; 21]);
    match Panorama::new(&mut caps, &mut sorted).allocate(problem, plan) {
        Ok(Answer::Planned(planned)) => Some(planned.steps),
        _ => None,
    }
}

fn main() {
    cotama_tests::with_patrol(|problem| {
        let mut plan = [0; 17];
        println!("exact: {:?} steps, {plan:?}", exact_patrol(black_box(problem), &mut plan));
        println!("panorama: {:?} steps, {plan:?}", panorama_patrol(black_box(problem), &mut plan));
    });
}
