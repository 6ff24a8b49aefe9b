//! The search by rising reduced cost, and the neighbourhood of the best plan.
//!
//! A dive that asks for the bound itself allows the fewest items; each "no" lowers the bound and
//! allows more. Where activities share the same ratio of value to cost, very many plans lie near
//! the bound and a dive need not end. Then the best plan is improved by freeing a few activities at
//! a time, in turns with the dive.

use super::Budget;
use super::congruence::Remainders;
use super::dive::Dive;
use super::dual::Price;
use super::item::Item;
use super::load::Frame;
use super::memory::{Seen, Stage};

/// Steps that the first dive may take before its turn ends; the next ones may take more.
const FIRST_TURN: u64 = 500;
const LONGER: u64 = 3;
/// How many activities are free in a neighbourhood, and how many nodes one may visit.
const FREE: usize = 10;
const NEIGHBOURHOOD: u64 = 10_000;
/// Neighbourhoods without a better plan after which the dive has its turn again.
const FRUITLESS: u64 = 200;

/// Searches until the best plan meets the bound, nothing is left, or the budget is spent. Takes the
/// value of the plan in [`Stage::best`], if there is one, and returns the new one and whether the
/// search was complete. `bound` is lowered to what is proven.
#[allow(clippy::too_many_arguments)] // the parts of one search, taken apart by the borrow checker
pub(super) fn search<const A: usize>(
    frame: &Frame<A>,
    price: &Price<A>,
    remainders: &Remainders,
    items: &[Item<A>],
    stages: &mut [Stage<A>],
    seen: &mut [Seen<A>],
    mut best: Option<i64>,
    bound: &mut i64,
    budget: &mut Budget,
) -> (Option<i64>, bool) {
    let mut dive = Dive::new(frame, price, remainders, items, stages, seen);
    dive.remember(FIRST_TURN / 4);
    let (mut width, mut turn, mut round) = (0i64, FIRST_TURN, 0);
    loop {
        debug_assert!(best.is_none_or(|value| value <= *bound), "no plan is above the bound");
        // A plan worth the bound, or every plan excluded.
        let floor = best.map_or(0, |value| value.saturating_add(1));
        if *bound < floor {
            return (best, true);
        }
        let target = bound.saturating_sub(width).max(floor);
        debug_assert!(floor <= target && target <= *bound, "a plan may be worth the target");
        dive.aim(target);
        dive.free_all();
        let complete = dive.run(budget, turn);
        if dive.target() > target {
            best = Some(dive.target().wrapping_sub(1));
        }
        debug_assert!(dive.target() >= target, "a dive only raises its target");
        if complete {
            *bound = dive.target().wrapping_sub(1);
            width = width.saturating_mul(2).saturating_add(1);
            continue;
        }
        if budget.left == 0 {
            return (best, false);
        }
        if let Some(value) = best.filter(|value| value < bound) {
            dive.aim(value.saturating_add(1));
            neighbours(&mut dive, *bound, &mut round, budget, turn);
            best = Some(dive.target().wrapping_sub(1));
        }
        turn = turn.saturating_mul(LONGER);
        dive.remember(turn);
    }
}

/// Looks for better plans that differ from the best one in a few activities, round after round,
/// until the turn ends, a plan meets the bound, or nothing better turns up any more.
fn neighbours<const A: usize>(
    dive: &mut Dive<'_, A>,
    bound: i64,
    round: &mut u64,
    budget: &mut Budget,
    turn: u64,
) {
    let end = budget.left.saturating_sub(turn);
    if budget.take(dive.stages().len() as u64).is_none() {
        return;
    }
    let (mut best, mut worst) = dive.best_point();
    let mut fruitless = 0u64;
    while dive.target() <= bound && budget.left > end && fruitless < turn / FRUITLESS {
        *round = round.wrapping_add(1);
        if budget.take(FREE as u64).is_none() {
            return;
        }
        let before = dive.target();
        dive.free_some(best, worst, FREE, *round);
        dive.run(budget, NEIGHBOURHOOD);
        if dive.target() > before {
            fruitless = 0;
            (best, worst) = dive.best_point();
        } else {
            fruitless = fruitless.saturating_add(1);
        }
    }
}
