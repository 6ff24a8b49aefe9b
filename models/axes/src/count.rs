//! Number of plans within limits: states with the same sums are one, with their number.

use crate::search::{Column, FREE};
use crate::steps::{Steps, Stop};
use std::collections::BTreeMap;

/// So many different sums are kept at once.
const MAX_STATES: usize = 1 << 20;

/// Returns how many ways there are to take a candidate in each activity within all limits; none
/// beyond 128 bits.
pub(crate) fn count(
    columns: &[Column],
    counts: &[usize],
    steps: &mut Steps,
) -> Result<Option<u128>, Stop> {
    let mut states = BTreeMap::from([(vec![0; columns.len()], 1_u128)]);
    let value = |column: &Column, activity: usize, choice: usize| {
        column.values.get(activity).and_then(|it| it.get(choice)).copied().unwrap_or(0)
    };
    for (activity, &candidates) in counts.iter().enumerate() {
        let mut next: BTreeMap<Vec<i64>, u128> = BTreeMap::new();
        let ends: Vec<_> = columns.iter().map(|it| sure(it, activity)).collect();
        for (sums, number) in &states {
            steps.take(candidates as u64)?;
            for choice in 0..candidates {
                let sums = sums
                    .iter()
                    .zip(columns)
                    .map(|(it, column)| it + value(column, activity, choice));
                let mut sums: Vec<_> = sums.collect();
                let limit = |it: &Column| it.limits.get(activity).copied().unwrap_or(FREE);
                if sums.iter().zip(columns).any(|(it, column)| *it > limit(column)) {
                    continue;
                }
                // Below the value from which each rest fits, all sums are one.
                sums.iter_mut().zip(&ends).for_each(|(it, end)| {
                    *it = if *end >= FREE / 2 { 0 } else { (*it).max(*end) };
                });
                let plans = next.entry(sums).or_insert(0);
                let Some(more) = plans.checked_add(*number) else { return Ok(None) };
                *plans = more;
            }
            if next.len() > MAX_STATES {
                return Err(Stop::Limit);
            }
        }
        states = next;
    }
    Ok(states.values().try_fold(0, |sum: u128, it| sum.checked_add(*it)))
}

/// Returns the value after an activity from which even the most expensive rest fits.
fn sure(column: &Column, activity: usize) -> i64 {
    let mut rest = 0;
    let mut sure = FREE;
    for (values, limit) in column.values.iter().zip(&column.limits).skip(activity + 1) {
        rest += values.iter().max().copied().unwrap_or(0);
        sure = if *limit < FREE { sure.min(limit - rest) } else { sure };
    }
    sure
}
