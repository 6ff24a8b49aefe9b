//! The rule of the paper (Lambert et al. 2024, Section 7.2): one limit after the other, from the
//! last activity back.

use crate::mission::{Kind, Mission};
use crate::table::Table;

/// Cause that the rule cannot be asked: a constraint that is not of the end, or asks for equality.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotTreated {
    /// The constraint, by index.
    pub constraint: usize,
}

/// Applies the rule to end constraints in this order; the final pick has the most of an indicator.
///
/// For each limit: from the highest candidate of each activity on, while the sum is above the
/// limit, the last activity is lowered to the highest that meets the limit, or else to its lowest,
/// and so on with the one before; then whatever is above the chosen value goes. A limit `at least`
/// is turned round, value and goal negated: a reading of this project. The rule can miss a plan.
///
/// # Errors
/// [`NotTreated`] names a constraint that the rule does not know.
pub fn rule(
    mission: &Mission,
    table: &Table,
    order: &[usize],
    pick: usize,
) -> Result<Option<Vec<usize>>, NotTreated> {
    let activities = &table.activities;
    let mut left: Vec<Vec<usize>> =
        activities.iter().map(|it| (0..it.candidates.len()).collect()).collect();
    if left.iter().any(Vec::is_empty) {
        return Ok(None);
    }
    for &constraint in order {
        let found = mission.constraints.get(constraint);
        let found = found.filter(|it| it.kind == Kind::End);
        let Some(it) = found else { return Err(NotTreated { constraint }) };
        let (sign, limit) = match (it.relation.most(it.goal), it.relation.least(it.goal)) {
            (Some(most), None) => (1, most),
            (None, Some(least)) => (-1, -least),
            _ => return Err(NotTreated { constraint }),
        };
        let cost = |activity: usize, choice: usize| {
            let candidate = activities.get(activity).and_then(|it| it.candidates.get(choice));
            sign * candidate.map_or(0, |candidate| candidate.value(it.indicator))
        };
        let costs = |(activity, kept): (usize, &Vec<usize>)| -> Vec<i64> {
            kept.iter().map(|&it| cost(activity, it)).collect()
        };
        let costs: Vec<_> = left.iter().enumerate().map(costs).collect();
        let mut tops: Vec<_> =
            costs.iter().map(|it| it.iter().max().copied().unwrap_or(0)).collect();
        let mut sum: i64 = tops.iter().sum();
        for (top, costs) in tops.iter_mut().zip(&costs).rev() {
            if sum <= limit {
                break;
            }
            let room = limit - sum + *top;
            let fitting = costs.iter().copied().filter(|&it| it <= room).max();
            let lower = fitting.or_else(|| costs.iter().min().copied()).unwrap_or(*top);
            sum += lower - *top;
            *top = lower;
        }
        if sum > limit {
            return Ok(None);
        }
        for ((activity, kept), top) in left.iter_mut().enumerate().zip(&tops) {
            kept.retain(|&it| cost(activity, it) <= *top);
        }
    }
    let highest = |(activity, kept): (&crate::table::Activity, &Vec<usize>)| {
        let value = |it: usize| activity.candidates.get(it).map_or(0, |it| it.value(pick));
        // The first of equals.
        kept.iter().copied().rev().max_by_key(|&it| value(it)).unwrap_or(0)
    };
    Ok(Some(activities.iter().zip(&left).map(highest).collect()))
}
