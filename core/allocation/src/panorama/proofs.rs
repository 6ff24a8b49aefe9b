//! The paper's rule: it ends, what it returns is within the limits, and what it says lacks, lacks.

use super::*;
use cotama_units::proofs::few;

fn c<const A: usize>(cost: [u32; A]) -> Candidate<A> {
    Candidate { cost, quality: 1, id: 0 }
}

fn small() -> [u32; 2] {
    [u32::from(few::<2>()), u32::from(few::<2>())]
}

/// A plan of the paper's rule is a plan of the problem, its totals are right and within every
/// limit; a limit that it says is not met is below what it says is needed.
#[kani::proof]
#[kani::unwind(4)]
pub fn every_plan_is_within_the_limits() {
    let (a, b) = ([c(small()), c(small())], [c(small()), c([2, 1])]);
    let activities = [&a[..], &b[..]];
    let limits = [2 * u64::from(few::<2>()), 1 + u64::from(few::<2>())];
    let order = if kani::any() { [0, 1] } else { [1, 0] };
    let Ok(problem) = Problem::new(&activities, limits, order) else { unreachable!() };
    let mut plan = [u16::MAX; 2];
    match Panorama::new(&mut [[0; 2]; 2]).allocate(&problem, &mut plan) {
        Ok(Answer::Planned(planned)) => {
            assert!(problem.totals(&plan) == Some((planned.cost, planned.quality)));
            assert!(problem.within_limits(&planned.cost));
            kani::cover!(planned.cost == limits, "both limits are used up");
        }
        Ok(Answer::Infeasible { shortfall, .. }) => {
            let Some(lacks) = shortfall else { unreachable!() };
            assert!(lacks.limit() == limits[lacks.axis()] && lacks.least() > lacks.limit());
            assert!(lacks.gap() > 0 && plan == [u16::MAX; 2]);
            kani::cover!(lacks.axis() == order[1], "the second limit is not met");
        }
        _ => unreachable!(),
    }
}

/// With one limit the paper's rule is complete: it finds a plan exactly when there is one.
#[kani::proof]
#[kani::unwind(4)]
pub fn with_one_limit_the_rule_is_complete() {
    let one = || c([u32::from(few::<2>())]);
    let (a, b) = ([one(), one(), one()], [one(), one()]);
    let (activities, limits) = ([&a[..], &b[..]], [u64::from(few::<3>())]);
    let Ok(problem) = Problem::new(&activities, limits, [0]) else { unreachable!() };
    let said = Panorama::new(&mut [[0]; 2]).allocate(&problem, &mut [0; 2]);
    let exists = problem.least(0) <= limits[0];
    assert!(matches!(said, Ok(Answer::Planned(_))) == exists);
    if let Ok(Answer::Infeasible { shortfall, .. }) = said {
        assert!(shortfall.is_some_and(|it| it.least() == problem.least(0)));
    }
    kani::cover!(exists && problem.least(0) == limits[0], "just so");
    kani::cover!(!exists, "infeasible");
}

/// The last activity is lowered first: with one limit an activity stays at its highest candidate
/// where the later ones, lowered as far as they go, leave room for it.
#[kani::proof]
#[kani::unwind(4)]
pub fn the_last_activity_is_lowered_first() {
    let one = || c([u32::from(few::<2>())]);
    let (a, b) = ([one(), one()], [one(), one(), one()]);
    let (activities, limits) = ([&a[..], &b[..]], [u64::from(few::<3>())]);
    let Ok(problem) = Problem::new(&activities, limits, [0]) else { unreachable!() };
    let mut plan = [0; 2];
    let said = Panorama::new(&mut [[0]; 2]).allocate(&problem, &mut plan);
    kani::assume(matches!(said, Ok(Answer::Planned(_))));
    let highest = |of: &[Candidate<1>]| of.iter().fold(0, |most, it| it.cost[0].max(most));
    let lowest = |of: &[Candidate<1>]| of.iter().fold(u32::MAX, |least, it| it.cost[0].min(least));
    let chosen = a[usize::from(plan[0])].cost[0];
    let room = u64::from(highest(&a)) + u64::from(lowest(&b)) <= limits[0];
    assert!((chosen == highest(&a)) == (room || highest(&a) == lowest(&a)));
    // The last is as high as the first at its highest leaves room for, and is not raised again.
    let last = b[usize::from(plan[1])].cost[0];
    let fits = |cost: &u32| u64::from(highest(&a)) + u64::from(*cost) <= limits[0];
    let highest_left = b.iter().map(|it| it.cost[0]).filter(fits).max();
    assert!(last == highest_left.unwrap_or(lowest(&b)));
    kani::cover!(room && plan[1] == 1 && highest(&b) > lowest(&b), "only the last is lowered");
    kani::cover!(!room && highest(&a) > lowest(&a), "both are");
}

/// The rule ends after at most two looks at every candidate for each axis and one more, whatever
/// the costs and limits, and no sum overflows.
#[kani::proof]
#[kani::unwind(4)]
pub fn it_ends() {
    let any = || Candidate { cost: kani::any::<[u32; 2]>(), quality: kani::any(), id: 0 };
    let (a, b) = ([any(), any()], [any(), any(), any()]);
    let activities = [&a[..], &b[..], &a[..1]];
    let Ok(problem) = Problem::new(&activities, kani::any(), [1, 0]) else { unreachable!() };
    let mut plan = [0; 3];
    let most = (2 * 2 + 1) * 6;
    match Panorama::new(&mut [[0; 2]; 3]).allocate(&problem, &mut plan) {
        Ok(Answer::Planned(planned)) => {
            assert!(planned.steps <= most && problem.within_limits(&planned.cost));
            // Unless they are, each is looked at once for the highest and at most once to choose.
            kani::cover!(planned.steps > 2 * 6, "some are lowered");
        }
        Ok(Answer::Infeasible { steps, .. }) => {
            assert!(steps <= most);
            kani::cover!(true, "infeasible");
        }
        _ => unreachable!(),
    }
}
