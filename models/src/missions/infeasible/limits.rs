//! Limits that cannot be met, and what they would have to be.

use super::trials::{Found, Plan, Trial, Trials};
use super::{HEAVIEST, Heavy, Reason, Relaxation};
use crate::missions::mission::Unfolded;
use cotama_core::exact::Objective;
use std::cmp::Ordering;

/// The reason when every activity has alternatives, its heaviest activities, and the limits raised.
pub(super) fn raised(
    trials: &mut Trials<'_>,
    mission: &Unfolded,
    as_is: &Trial<'_>,
    steps: u64,
) -> (Reason, Vec<Heavy>, Vec<Relaxation>) {
    let mut raised = Vec::new();
    let mut neither = true;
    for axis in mission.order {
        let mut limits = as_is.limits;
        limits[axis] = u64::MAX;
        match trials.run(&Trial { limits, ..as_is.clone() }, Some(Objective::Least(axis))) {
            Found::Plan(plan) => raised.push((raise(as_is.limits, plan.cost), plan)),
            Found::Nothing => continue,
            Found::Unknown => {}
        }
        neither = false;
    }
    // The cheapest plan on one axis is at hand without a search. It is what is left when neither
    // limit can be met, and a plan to name when a search was stopped.
    if raised.is_empty() {
        for axis in mission.order {
            let mut plan = trials.cheapest(as_is, axis);
            plan.best = plan.cost[1 - axis] <= as_is.limits[1 - axis];
            raised.push((raise(as_is.limits, plan.cost), plan));
        }
    }
    raised.sort_by(|(a, _), (b, _)| by_size(a, b));
    raised.dedup_by(|(a, _), (b, _)| a == b);

    let (reason, heaviest) = match raised.first() {
        _ if neither => {
            let cheapest = [0, 1].map(|axis| trials.cheapest(as_is, axis));
            let [first, _] = mission.order;
            let least = [0, 1].map(|axis| cheapest[axis].cost[axis]);
            (Reason::Limits { limits: as_is.limits, least }, heaviest(&cheapest[first], first))
        }
        // A plan that may not be the cheapest proves nothing of its limit.
        Some((Relaxation::RaiseLimit { axis, from, to }, plan)) if plan.best => {
            (Reason::Limit { axis: *axis, limit: *from, least: *to }, heaviest(plan, *axis))
        }
        _ => (Reason::SomeLimit { steps }, vec![]),
    };
    (reason, heaviest, raised.into_iter().map(|(relaxation, _)| relaxation).collect())
}

/// Raises the limits to what a plan costs where that is above them.
fn raise(from: [u64; 2], cost: [u64; 2]) -> Relaxation {
    match [0, 1].map(|axis| cost[axis] > from[axis]) {
        [true, true] => Relaxation::RaiseLimits { from, to: cost },
        [duration, _] => {
            let axis = usize::from(!duration);
            Relaxation::RaiseLimit { axis, from: from[axis], to: cost[axis] }
        }
    }
}

impl Relaxation {
    /// Orders raised limits as an explanation lists them: by the larger part of a limit that they
    /// add, and then by axis and amount.
    ///
    /// ```
    /// use cotama_models::missions::infeasible::Relaxation::RaiseLimit;
    /// let energy = RaiseLimit { axis: 1, from: 1_000, to: 1_099 }; // 9.9 % more
    /// let duration = RaiseLimit { axis: 0, from: 10, to: 11 }; // 10 %
    /// assert!(energy.by_size(&duration).is_lt());
    /// ```
    pub fn by_size(&self, other: &Self) -> Ordering {
        by_size(self, other)
    }
}

fn by_size(a: &Relaxation, b: &Relaxation) -> Ordering {
    // The part is a fraction of two whole numbers; fractions are compared by multiplying across. Of
    // a limit of nothing every part is larger than any.
    type Part = (u128, u128);
    let compare = |a: Part, b: Part| match (a.1, b.1) {
        (0, 0) => a.0.cmp(&b.0),
        _ => (a.0 * b.1).cmp(&(b.0 * a.1)),
    };
    let part = |from: u64, to: u64| (u128::from(to - from), u128::from(from));
    let key = |relaxation: &Relaxation| match *relaxation {
        Relaxation::RaiseLimit { axis, from, to } => (part(from, to), axis, [to, to]),
        Relaxation::RaiseLimits { from, to } => {
            let [duration, energy] = [0, 1].map(|axis| part(from[axis], to[axis].max(from[axis])));
            (if compare(duration, energy).is_lt() { energy } else { duration }, 2, to)
        }
        _ => ((0, 0), 3, [0, 0]),
    };
    let ((a, a_axis, a_to), (b, b_axis, b_to)) = (key(a), key(b));
    compare(a, b).then(a_axis.cmp(&b_axis)).then(a_to.cmp(&b_to))
}

fn heaviest(plan: &Plan, axis: usize) -> Vec<Heavy> {
    let total = plan.cost[axis].max(1);
    let mut all: Vec<_> =
        plan.activities.iter().map(|&(activity, cost)| (activity, cost[axis])).collect();
    all.sort_by_key(|&(activity, cost)| (std::cmp::Reverse(cost), activity));
    all.truncate(HEAVIEST);
    let heavy = |(activity, cost): (usize, u32)| {
        let permille = (u64::from(cost) * 1000 + total / 2) / total;
        Heavy { activity, axis, cost, permille: permille as u16 }
    };
    all.into_iter().map(heavy).collect()
}
