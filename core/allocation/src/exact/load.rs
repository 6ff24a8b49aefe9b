//! The problem as the search sees it: costs above the least, values above the least, dominated
//! candidates gone.

use super::rows::{Rows, sum};
use super::{Item, Objective, Stage};
use crate::order::{keep_undominated, numbered, sort_by_key};
use crate::problem::{Candidate, Problem, cheapest};

/// One objective of a lexicographic order (none: any plan will do), and what those before it have
/// fixed.
pub(super) struct Aim<const A: usize> {
    pub(super) objective: Option<Objective>,
    pub(super) limits: [u64; A],
    pub(super) quality_floor: u64,
}

/// Constants shared by all activities.
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

impl<const A: usize> Frame<A> {
    /// A whole value with this frame's fraction bits.
    #[inline]
    pub(super) const fn priced(&self, value: i64) -> i64 {
        value.wrapping_shl(self.fraction)
    }

    /// A priced value without its fraction, rounded down.
    #[inline]
    pub(super) const fn whole(&self, priced: i64) -> i64 {
        priced.wrapping_shr(self.fraction)
    }
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
        for (axis, room) in numbered(&mut room.axes) {
            *room = room.saturating_sub(i64::from(cheapest(candidates, axis)));
        }
        let best_quality = candidates.iter().map(|c| c.quality).max().unwrap_or(0);
        deficit_room = deficit_room.saturating_add(i128::from(best_quality));
    }
    debug_assert!(i64::try_from(deficit_room).is_ok(), "a quality that a plan has is a floor");
    room.quality = i64::try_from(deficit_room).unwrap_or(i64::MIN);
    if !room.none_negative() {
        return None;
    }
    let floored = aim.quality_floor > 0;

    let mut first = 0;
    for (candidates, stage) in problem.activities().iter().zip(stages.iter_mut()) {
        let cheapest: [u32; A] = core::array::from_fn(|axis| cheapest(candidates, axis));
        let best_quality = candidates.iter().map(|c| c.quality).max().unwrap_or(0);
        let least = candidates.iter().map(|c| value(c, aim.objective)).min().unwrap_or(0);
        debug_assert!(first <= items.len(), "an item a candidate");
        let own = items.get_mut(first..).unwrap_or(&mut []);
        let mut count = 0usize;
        for (choice, candidate) in numbered(candidates.iter()) {
            let mut cost = candidate.cost;
            for (cost, &cheapest) in cost.iter_mut().zip(&cheapest) {
                *cost = cost.saturating_sub(cheapest);
            }
            let deficit = if floored { best_quality.saturating_sub(candidate.quality) } else { 0 };
            let above = value(candidate, aim.objective).abs_diff(least);
            debug_assert!(u32::try_from(above).is_ok(), "values of one objective span 32 bits");
            let value = above as u32;
            let item = Item::new(cost, deficit, value, choice as u16);
            if room.minus(&item.rows()).none_negative() {
                *own.get_mut(count)? = item;
                count = count.wrapping_add(1);
            }
        }
        let kept = undominated(own.get_mut(..count).unwrap_or(&mut []));
        if kept.is_empty() {
            return None;
        }
        debug_assert!(u16::try_from(kept.len()).is_ok(), "an item is a candidate");
        *stage = Stage { first: first as u32, count: kept.len() as u16, ..Stage::EMPTY };
        let most_of = |row: usize| kept.iter().map(|i| i.rows().get(row)).max().unwrap_or(0);
        for row in 0..Rows::<A>::COUNT {
            largest.set(row, sum(largest.get(row), most_of(row)));
        }
        most = sum(most, kept.iter().map(|i| i64::from(i.value)).max().unwrap_or(0));
        least_value = least_value.saturating_add(i128::from(least));
        first = first.wrapping_add(kept.len());
    }

    debug_assert!(most >> 48 == 0, "sums of values fit 48 bits, as nodes keep them");
    let mut frame = Frame {
        room: room.zip(&largest, i64::min),
        least_value,
        most,
        fraction: most.leading_zeros().saturating_sub(i64::BITS - 50).min(40),
        most_multiplier: Rows::ZERO,
    };
    for row in 0..Rows::<A>::COUNT {
        if largest.get(row) > room.get(row) {
            let share = (1u64 << 60) / Rows::<A>::COUNT as u64;
            let most = share.checked_div(largest.get(row).unsigned_abs()).unwrap_or(0);
            frame.most_multiplier.set(row, most.cast_signed());
        }
    }
    Some(frame)
}

/// How many kept items a new one is compared with; a bound on the work for very long candidate
/// lists.
const COMPARED: usize = 1024;

/// Sorts the items canonically (best value, then cheapest, then first written) and moves those that
/// no other dominates to the front; returns those.
fn undominated<const A: usize>(items: &mut [Item<A>]) -> &[Item<A>] {
    sort_by_key(items, |i| (core::cmp::Reverse(i.value), i.cost, i.deficit, i.choice()));
    debug_assert!(items.is_sorted_by_key(|i| core::cmp::Reverse(i.value)), "the best value first");
    keep_undominated(items, COMPARED, |other, item| {
        // Whatever comes before has at least its value.
        other.deficit <= item.deficit && other.cost.iter().zip(&item.cost).all(|(a, b)| a <= b)
    })
}
