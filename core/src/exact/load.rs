//! The problem as the search sees it: costs above the least, values above the least, dominated
//! candidates gone.

use super::rows::Rows;
use super::{Item, Objective, Stage};
use crate::problem::{Candidate, Problem};

/// One objective of a lexicographic order (none: any plan will do), and what those before it have
/// fixed.
pub(super) struct Aim<const A: usize> {
    pub(super) objective: Option<Objective>,
    pub(super) limits: [u64; A],
    pub(super) quality_floor: u64,
}

/// What is the same for all activities.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<const A: usize> {
    /// Room in each row above what the cheapest candidates take.
    pub(super) room: Rows<A>,
    /// The value of a plan that takes the least of each activity.
    pub(super) least_value: i128,
    /// The sum of the largest values above that: a first bound.
    pub(super) most: i64,
    /// Fraction bits of multipliers and priced values.
    pub(super) fraction: u32,
    /// The largest multiplier of each row for which no priced sum overflows; zero for a row that
    /// has room for anything and so never binds.
    pub(super) most_multiplier: Rows<A>,
}

/// The value of a candidate under an objective, larger is better; at most 2^32 in size.
fn value<const A: usize>(candidate: &Candidate<A>, objective: Option<Objective>) -> i64 {
    let cost = |axis: usize| candidate.cost.get(axis).map_or(0, |&cost| i64::from(cost));
    match objective {
        Some(Objective::MostQuality) => i64::from(candidate.quality),
        Some(Objective::Least(axis)) => -cost(axis),
        Some(Objective::Most(axis)) => cost(axis),
        None => 0,
    }
}

/// Fills `items` and `stages` from a problem; `None` when some activity has no candidate that fits
/// beside the cheapest of the others.
pub(super) fn load<const A: usize>(
    problem: &Problem<'_, A>,
    aim: &Aim<A>,
    items: &mut [Item<A>],
    stages: &mut [Stage<A>],
) -> Option<Frame<A>> {
    let mut room =
        Rows { axes: aim.limits.map(|limit| limit.min(1 << 62).cast_signed()), quality: 0 };
    let mut deficit_room = -i128::from(aim.quality_floor);
    let mut largest = Rows::<A>::ZERO;
    let (mut least_value, mut most) = (0i128, 0i64);

    // Room first: an item too large for it can then be left out at once.
    for candidates in problem.activities() {
        for axis in 0..A {
            let cheapest = candidates.iter().map(|c| c.cost[axis]).min().unwrap_or(0);
            room.axes[axis] = room.axes[axis].saturating_sub(i64::from(cheapest));
        }
        deficit_room += i128::from(candidates.iter().map(|c| c.quality).max().unwrap_or(0));
    }
    room.quality = i64::try_from(deficit_room).unwrap_or(i64::MIN);
    if !room.none_negative() {
        return None;
    }
    let floored = aim.quality_floor > 0;

    let mut first = 0;
    for (candidates, stage) in problem.activities().iter().zip(stages.iter_mut()) {
        let cheapest: [u32; A] =
            core::array::from_fn(|axis| candidates.iter().map(|c| c.cost[axis]).min().unwrap_or(0));
        let best_quality = candidates.iter().map(|c| c.quality).max().unwrap_or(0);
        let least = candidates.iter().map(|c| value(c, aim.objective)).min().unwrap_or(0);
        let mut count = 0;
        for (choice, candidate) in candidates.iter().enumerate() {
            items[first + count] = Item {
                cost: core::array::from_fn(|axis| candidate.cost[axis] - cheapest[axis]),
                deficit: if floored { best_quality - candidate.quality } else { 0 },
                value: (value(candidate, aim.objective) - least).unsigned_abs() as u32,
                loss: 0,
                choice: choice as u16,
            };
            let fits = items[first + count].rows().zip(&room, |cost, room| room - cost);
            count += usize::from(fits.none_negative());
        }
        if count == 0 {
            return None;
        }
        let kept = undominated(&mut items[first..first + count]);
        *stage = Stage { first: first as u32, count: kept as u32, ..Stage::EMPTY };
        let kept = &items[first..first + kept];
        for axis in 0..A {
            largest.axes[axis] += kept.iter().map(|i| i64::from(i.cost[axis])).max().unwrap_or(0);
        }
        largest.quality += kept.iter().map(|i| i64::from(i.deficit)).max().unwrap_or(0);
        most += kept.iter().map(|i| i64::from(i.value)).max().unwrap_or(0);
        least_value += i128::from(least);
        first += kept.len();
    }

    let mut frame = Frame {
        room: room.zip(&largest, i64::min),
        least_value,
        most,
        fraction: 50u32.saturating_sub(i64::BITS - most.leading_zeros()).min(40),
        most_multiplier: Rows::ZERO,
    };
    for row in 0..Rows::<A>::COUNT {
        if largest.get(row) > room.get(row) {
            frame
                .most_multiplier
                .set(row, (1 << 60) / (Rows::<A>::COUNT as u64).cast_signed() / largest.get(row));
        }
    }
    Some(frame)
}

/// How many kept items a new one is compared with; a bound on the work for very long candidate
/// lists.
const COMPARED: usize = 1024;

/// Sorts the items canonically (best value, then cheapest, then first written) and moves those that
/// no other dominates to the front; returns their number.
fn undominated<const A: usize>(items: &mut [Item<A>]) -> usize {
    items.sort_unstable_by_key(|i| (core::cmp::Reverse(i.value), i.cost, i.deficit, i.choice));
    let mut kept = 0;
    for next in 0..items.len() {
        let item = items[next];
        // Whatever comes before has at least its value.
        let dominated = items[kept.max(COMPARED) - COMPARED..kept].iter().any(|other| {
            other.deficit <= item.deficit && other.cost.iter().zip(&item.cost).all(|(a, b)| a <= b)
        });
        if !dominated {
            items[kept] = item;
            kept += 1;
        }
    }
    kept
}
