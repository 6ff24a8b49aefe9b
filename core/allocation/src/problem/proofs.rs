//! The figures that a problem reports are those of its tables.

use super::*;
use cotama_units::proofs::few;

/// An order of treatment is accepted exactly when it names every axis once.
#[kani::proof]
#[kani::unwind(4)]
pub fn an_order_names_every_axis_once() {
    let order = [0; 3].map(|_: u8| usize::from(few::<2>()));
    let mut named = [false; 4];
    order.iter().for_each(|&axis| named[axis] = true);
    let candidates = [Candidate { cost: [1; 3], quality: 0, id: 0 }];
    let activities = [&candidates[..]];
    let made = Problem::new(&activities, [1; 3], order);
    assert!(made.is_ok() == (named == [true, true, true, false]));
    kani::cover!(made.is_ok() && order == [2, 0, 1], "turned around");
    kani::cover!(made.is_err() && order == [0, 1, 1], "one twice");
}

/// The totals of a plan are the sums of what it chooses, at least the least on every axis; what
/// chooses a candidate that is not there is no plan.
#[kani::proof]
#[kani::unwind(4)]
pub fn totals_are_sums() {
    let cost = || [u32::from(few::<2>()), u32::from(few::<1>())];
    let c = |quality| Candidate { cost: cost(), quality, id: 0 };
    let (a, b) = ([c(1), c(2)], [c(4), c(8), c(16)]);
    let activities = [&a[..], &b[..]];
    let Ok(problem) = Problem::new(&activities, [3, 1], [0, 1]) else { unreachable!() };
    let plan = [u16::from(few::<2>()), u16::from(few::<2>())];
    let (one, other) = (a.get(usize::from(plan[0])), b.get(usize::from(plan[1])));
    let exact = one.zip(other).map(|(one, other)| {
        let sum = |axis: usize| u64::from(one.cost[axis]) + u64::from(other.cost[axis]);
        ([sum(0), sum(1)], u64::from(one.quality + other.quality))
    });
    assert!(problem.totals(&plan) == exact);
    if let Some((cost, _)) = exact {
        assert!(problem.least(0) <= cost[0] && problem.least(1) <= cost[1]);
        assert!(problem.within_limits(&cost) == (cost[0] <= 3 && cost[1] <= 1));
    }
    assert!(problem.totals(&plan[..1]).is_none());
    kani::cover!(exact.is_some_and(|it| it.0 == [3, 1]), "both limits met exactly");
    kani::cover!(exact.is_none(), "no plan");
}
