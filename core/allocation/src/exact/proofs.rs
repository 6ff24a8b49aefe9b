//! The exact allocator against all plans of small problems.

use super::*;
use cotama_units::proofs::few;

fn c(cost: [u32; 2], quality: u32) -> Candidate<2> {
    Candidate { cost, quality, id: 0 }
}

fn bit() -> u32 {
    u32::from(few::<1>())
}

/// Every plan of two activities, with its totals.
fn plans<'p>(problem: &'p Problem<'_, 2>) -> impl Iterator<Item = ([u64; 2], u64)> + 'p {
    (0..9).filter_map(|it| problem.totals(&[it / 3, it % 3]))
}

/// The most quality within the limits.
fn best(problem: &Problem<'_, 2>) -> Option<u64> {
    plans(problem).filter(|it| problem.within_limits(&it.0)).map(|it| it.1).max()
}

/// With steps enough, the answer is a plan within the limits that no other one beats, and known to
/// be; or there is none.
#[kani::proof]
#[kani::unwind(10)]
pub fn the_best_plan_is_found_or_there_is_none() {
    let (a, b) = (
        [c([2 * bit(), bit() + bit()], 2), c([bit() + bit(), bit()], 3 * bit())],
        [c([bit() + bit(), 2 * bit()], 1 + bit()), c([2, bit()], 2 + 2 * bit()), c([1, 1], bit())],
    );
    let activities = [&a[..], &b[..]];
    let limits = [u64::from(few::<2>()), u64::from(few::<2>())];
    let Ok(problem) = Problem::new(&activities, limits, [0, 1]) else { unreachable!() };
    let (mut items, mut stages) = ([Item::EMPTY; 5], [Stage::EMPTY; 2]);
    let mut exact = Exact::new(&[Objective::MostQuality], 10_000, &mut items, &mut stages);
    let mut plan = [u16::MAX; 2];
    match exact.allocate(&problem, &mut plan) {
        Ok(Answer::Planned(planned)) => {
            assert!(problem.totals(&plan) == Some((planned.cost, planned.quality)));
            assert!(problem.within_limits(&planned.cost));
            assert!(best(&problem) == Some(planned.quality));
            assert!(planned.optimal && planned.bound == Some(planned.quality));
            kani::cover!(planned.cost == limits, "both limits are used up");
        }
        Ok(Answer::Infeasible { shortfall, .. }) => {
            assert!(best(&problem).is_none());
            let Some(lacks) = shortfall else { unreachable!() };
            assert!(lacks.limit() == limits[lacks.axis()]);
            // The least of the second limit over plans within the first.
            let within = |cost: &[u64; 2]| lacks.axis() == 0 || cost[0] <= limits[0];
            let least =
                plans(&problem).map(|it| it.0).filter(within).map(|it| it[lacks.axis()]).min();
            assert!(least == Some(lacks.least()));
            kani::cover!(lacks.axis() == 1, "the second limit is not met");
        }
        _ => unreachable!(),
    }
}

/// Whatever the budget of steps, a plan is within the limits, no plan is better than the bound,
/// the budget is kept, and *infeasible* is said of nothing that has a plan.
#[kani::proof]
#[kani::unwind(10)]
pub fn the_bound_holds_whatever_the_budget() {
    let (a, b) = (
        [c([1 + bit(), 2], 2 + bit()), c([bit(), 1], 1)],
        [c([2 * bit(), bit()], 1), c([2, 1], 2 + 2 * bit()), c([1, bit()], bit())],
    );
    let activities = [&a[..], &b[..]];
    let limits = [1 + u64::from(few::<1>()), 2 + u64::from(few::<1>())];
    let Ok(problem) = Problem::new(&activities, limits, [0, 1]) else { unreachable!() };
    let (mut items, mut stages) = ([Item::EMPTY; 5], [Stage::EMPTY; 2]);
    let budget = 4 * u64::from(few::<6>());
    let mut exact = Exact::new(&[Objective::MostQuality], budget, &mut items, &mut stages);
    let mut plan = [0; 2];
    let best = best(&problem);
    let spent = match exact.allocate(&problem, &mut plan) {
        Ok(Answer::Planned(planned)) => {
            assert!(problem.totals(&plan) == Some((planned.cost, planned.quality)));
            assert!(problem.within_limits(&planned.cost) && planned.bound >= best);
            assert!(!planned.optimal || best == Some(planned.quality));
            kani::cover!(!planned.optimal, "not known to be the best");
            planned.steps
        }
        Ok(Answer::Infeasible { steps, .. }) => {
            assert!(best.is_none());
            steps
        }
        Ok(Answer::Unknown { bound, steps }) => {
            assert!(best.is_none_or(|it| it <= bound));
            kani::cover!(best.is_some(), "not found in time");
            steps
        }
        Err(_) => unreachable!(),
    };
    assert!(spent <= budget);
}

/// A candidate that another one of its activity beats on both axes and in quality changes no
/// answer.
#[kani::proof]
#[kani::unwind(10)]
pub fn a_dominated_candidate_changes_nothing() {
    let better = c([u32::from(few::<2>()), bit()], 1 + bit());
    let worse = c([better.cost[0] + 2 * bit(), better.cost[1] + bit()], better.quality - bit());
    let other = c([bit(), 2 * bit()], 2 * bit());
    let (a, b) = ([better, other, worse], [c([1, bit()], 2), c([0, 1 + bit()], bit())]);
    let (with, without) = ([&a[..], &b[..]], [&a[..2], &b[..]]);
    let limits = [u64::from(few::<2>()), 1 + u64::from(few::<1>())];
    let answer = |activities: &[&[Candidate<2>]]| {
        let Ok(problem) = Problem::new(activities, limits, [1, 0]) else { unreachable!() };
        let (mut items, mut stages) = ([Item::EMPTY; 5], [Stage::EMPTY; 2]);
        let mut exact = Exact::new(&[Objective::MostQuality], 10_000, &mut items, &mut stages);
        match exact.allocate(&problem, &mut [0; 2]) {
            Ok(Answer::Planned(planned)) => Some(planned.quality),
            Ok(Answer::Infeasible { .. }) => None,
            _ => unreachable!(),
        }
    };
    assert!(answer(&with) == answer(&without));
    let Ok(problem) = Problem::new(&with, limits, [1, 0]) else { unreachable!() };
    assert!(answer(&with) == best(&problem));
    kani::cover!(worse == better, "an equal one");
    kani::cover!(answer(&with).is_some() && worse.quality < better.quality, "a worse one");
}
