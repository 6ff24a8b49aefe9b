//! One column for all limits: the wanted sum, and each limited sum weighed by what its limit costs.
//!
//! A plan within all limits is within their weighed sum, too. Of weights near the best ones of
//! Lagrange (Geoffrion, "Lagrangean relaxation for integer programming", 1974) this says early that
//! no rest leads to less of what is wanted.

use crate::search::{Column, FREE};

/// Parts of a unit of a weight, as a power of two; a weight has at most 256 units.
const PARTS: u32 = 16;
const MOST: i128 = 256 << PARTS;
/// So many times weights are moved.
const ROUNDS: i128 = 300;
/// Sums of the column stay below this.
const LARGEST: i128 = 400_000_000_000_000_000;

/// A column that is limited at the end, less the least of each activity.
struct Limited<'c> {
    column: &'c Column,
    least: Vec<i64>,
    /// Sum of all differences of an activity's most and least.
    range: i128,
    /// Most that the sum may be above the least.
    room: i128,
    /// Weight of a unit, and how many parts of units are taken.
    unit: i128,
    parts: i128,
}

impl<'c> Limited<'c> {
    fn new(column: &'c Column) -> Self {
        let of = |it: &Vec<i64>| {
            (it.iter().min().copied().unwrap_or(0), it.iter().max().copied().unwrap_or(0))
        };
        let ends: Vec<_> = column.values.iter().map(of).collect();
        let least: Vec<_> = ends.iter().map(|it| it.0).collect();
        let sum: i128 = least.iter().map(|&it| i128::from(it)).sum();
        let most: i128 = ends.iter().map(|it| i128::from(it.1)).sum();
        let limit = i128::from(column.limits.last().copied().unwrap_or(FREE));
        Self { column, least, range: most - sum, room: limit - sum, unit: 0, parts: 0 }
    }

    /// Amount by which a candidate is above the least of its activity.
    fn above(&self, activity: usize, choice: usize) -> i128 {
        let value = self.column.values.get(activity).and_then(|it| it.get(choice));
        let least = self.least.get(activity).copied().unwrap_or(0);
        i128::from(value.copied().unwrap_or(0)) - i128::from(least)
    }

    fn weight(&self) -> i128 {
        (self.unit * self.parts) >> PARTS
    }
}

/// Returns the weighed column of columns of which the last may be wanted and the others are
/// limited. Its limit is that of plans with at most `most` of what is wanted; without `most` limits
/// alone are weighed, so that it may show that there is no plan. None where no limit binds.
pub(crate) fn surrogate(columns: &[Column], counts: &[usize], most: Option<i64>) -> Option<Column> {
    let mut wanted = Limited::new(columns.last()?);
    let others = columns.iter().filter(|it| !it.wanted).map(Limited::new);
    let mut limited: Vec<_> =
        others.filter(|it| it.range > 0 && (0..it.range).contains(&it.room)).collect();
    if limited.is_empty() || most.is_some() && wanted.range == 0 {
        return None;
    }
    // A unit of weight makes each limited sum range as widely as the wanted one.
    wanted.unit = if most.is_some() { 1 << 20 } else { 0 };
    wanted.parts = 1 << PARTS;
    let scale = if most.is_some() { wanted.unit * wanted.range } else { LARGEST << 20 };
    for it in &mut limited {
        it.unit = (scale / it.range).max(1);
        it.parts = if most.is_some() { 0 } else { 1 << PARTS };
    }
    let weighed = |limited: &[Limited<'_>], activity: usize, choice: usize| -> i128 {
        let own = |it: &Limited<'_>| it.weight() * it.above(activity, choice);
        own(&wanted) + limited.iter().map(own).sum::<i128>()
    };
    let mut best: Option<(i128, Vec<i128>)> = None;
    for round in 0..ROUNDS {
        let mut bound: i128 = -limited.iter().map(|it| it.weight() * it.room).sum::<i128>();
        let mut used = vec![0; limited.len()];
        for (activity, &count) in counts.iter().enumerate() {
            let all = (0..count).map(|choice| (weighed(&limited, activity, choice), choice));
            let (value, choice) = all.min()?;
            bound += value;
            let more = limited.iter().map(|it| it.above(activity, choice));
            used.iter_mut().zip(more).for_each(|(used, more): (&mut i128, i128)| *used += more);
        }
        if most.is_none() {
            // Of limits alone the direction counts, and not how large weights are.
            bound = (bound << 8) / (1 + limited.iter().map(|it| it.parts).sum::<i128>());
        }
        if best.as_ref().is_none_or(|it| bound > it.0) {
            best = Some((bound, limited.iter().map(|it| it.parts).collect()));
        }
        for (it, used) in limited.iter_mut().zip(used) {
            // How far the cheapest choice is off, as a share, in ever smaller steps.
            let off = ((used - it.room) << (PARTS + 3)) / it.range;
            it.parts = (it.parts + off / (round + 4)).clamp(0, MOST);
        }
    }
    let (_, parts) = best?;
    limited.iter_mut().zip(parts).for_each(|(it, parts)| it.parts = parts);
    let sums = limited.iter().chain([&wanted]).map(|it| it.weight() * it.range);
    // Rounded down, values of a plan stay within the limit, rounded down.
    let divisor = sums.sum::<i128>() / LARGEST + 1;
    let row = |(activity, &count): (usize, &usize)| {
        let value = |choice| (weighed(&limited, activity, choice) / divisor) as i64;
        (0..count).map(value).collect()
    };
    let mut limits = vec![FREE; counts.len()];
    if let Some(limit) = limits.last_mut() {
        let least: i64 = wanted.least.iter().sum();
        let room: i128 = limited.iter().map(|it| it.weight() * it.room).sum();
        let whole = most.map_or(0, |it| wanted.weight() * i128::from(it - least)) + room;
        *limit = whole.div_euclid(divisor).clamp(-1, i128::from(FREE)) as i64;
    }
    Some(Column { values: counts.iter().enumerate().map(row).collect(), limits, wanted: false })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Values = Vec<Vec<i64>>;

    /// Sums of all plans.
    fn sums(values: &Values) -> Vec<i64> {
        let longer = |sums: Vec<i64>, own: &Vec<i64>| {
            sums.iter().flat_map(|sum| own.iter().map(move |it| sum + it)).collect()
        };
        values.iter().fold(vec![0], longer)
    }

    proptest! {
        #[test]
        fn a_plan_within_all_limits_is_within_their_weighed_sum(
            columns in proptest::collection::vec(
                (proptest::collection::vec(proptest::collection::vec(-900..900_i64, 3), 5),
                 -1_500..1_500_i64),
                2..5,
            ),
            with_wish in any::<bool>(),
        ) {
            let column = |(number, (values, limit)): (usize, &(Values, i64))| {
                let wanted = with_wish && number + 1 == columns.len();
                let last = if wanted { FREE } else { *limit };
                let limits = vec![FREE, FREE, FREE, FREE, last];
                Column { values: values.clone(), limits, wanted }
            };
            let made: Vec<_> = columns.iter().enumerate().map(column).collect();
            let most = with_wish.then(|| columns[columns.len() - 1].1);
            if let Some(found) = surrogate(&made, &[3; 5], most) {
                let limit = found.limits[4];
                prop_assert!(limit < FREE);
                let all: Vec<_> = columns.iter().map(|it| sums(&it.0)).collect();
                for (plan, sum) in sums(&found.values).into_iter().enumerate() {
                    let within = columns.iter().zip(&all).all(|(it, sums)| sums[plan] <= it.1);
                    prop_assert!(!within || sum <= limit, "{plan}: {sum} above {limit}");
                }
            }
        }
    }
}
