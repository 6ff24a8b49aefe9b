//! A first plan: the best items at the dual prices, repaired until it fits, then improved.

use super::dual::Price;
use super::load::Frame;
use super::rows::{Rows, difference, sum};
use super::{Budget, Item, Stage};
use crate::order::{numbered, sort_by_key};

/// Sets every item's reduced cost at these prices, sorts each activity's items by it (equal ones
/// keep the canonical order) and looks for a plan near the best items. Returns its value, the plan
/// in [`Stage::best`].
pub(super) fn first_plan<const A: usize>(
    frame: &Frame<A>,
    price: &Price<A>,
    items: &mut [Item<A>],
    stages: &mut [Stage<A>],
    budget: &mut Budget,
) -> Option<i64> {
    let mut slack = frame.room;
    for stage in stages.iter_mut() {
        let own = items.get_mut(stage.range()).unwrap_or(&mut []);
        let best =
            own.iter().map(|i| i.reduced(&price.multiplier, frame.fraction)).max().unwrap_or(0);
        for item in own.iter_mut() {
            item.set_reduced_cost(difference(
                best,
                item.reduced(&price.multiplier, frame.fraction),
            ));
        }
        // The canonical order, as a key: items of equal reduced cost come out as dominance sorted
        // them.
        sort_by_key(own, |i| {
            (i.reduced_cost(), core::cmp::Reverse(i.value), i.cost, i.deficit, i.choice())
        });
        let first = own.first().map(Item::reduced_cost);
        debug_assert_eq!(first, Some(0), "the best item at these prices comes first");
        stage.best = 0;
        slack = slack.minus(&stage.item(items, 0).rows());
    }
    // Each switch scans all activities; a plan that needs more switches than this is left to the
    // search.
    for _ in 0..stages.len().saturating_add(8) {
        if slack.none_negative() {
            break;
        }
        budget.take(stages.len() as u64)?;
        slack = repair(items, stages, &slack)?;
    }
    if !slack.none_negative() {
        return None;
    }
    debug_assert!(is_slack(frame, items, stages, &slack), "the slack is that of the plan");
    while budget.take(stages.len() as u64).is_some() {
        match improve(items, stages, &slack) {
            Some(better) => slack = better,
            None => break,
        }
    }
    let mut value = 0i64;
    for stage in stages.iter() {
        value = sum(value, i64::from(stage.item(items, stage.best).value));
    }
    Some(value)
}

/// Whether this is what the plan in [`Stage::best`] leaves of the room.
fn is_slack<const A: usize>(
    frame: &Frame<A>,
    items: &[Item<A>],
    stages: &[Stage<A>],
    slack: &Rows<A>,
) -> bool {
    let rows = stages.iter().map(|stage| stage.item(items, stage.best).rows());
    rows.fold(frame.room, |left, taken| left.minus(&taken)) == *slack
}

/// How far over the room a slack is, each row as parts of 2^20 of its worst.
fn violation<const A: usize>(slack: &Rows<A>, worst: &Rows<A>) -> i64 {
    let parts = (0..Rows::<A>::COUNT).map(|row| match (slack.get(row), worst.get(row)) {
        (over, least) if over < 0 && least < 0 => {
            (i128::from(over) << 20).checked_div(i128::from(least)).unwrap_or(0) as i64
        }
        (over, _) if over < 0 => 1 << 20,
        _ => 0,
    });
    parts.fold(0, i64::saturating_add)
}

fn product(a: i64, b: i64) -> i128 {
    i128::from(a).wrapping_mul(i128::from(b))
}

/// Makes the one switch that costs the least reduced cost for the violation it removes; `None` when
/// none removes any.
fn repair<const A: usize>(
    items: &[Item<A>],
    stages: &mut [Stage<A>],
    slack: &Rows<A>,
) -> Option<Rows<A>> {
    let before = violation(slack, slack);
    let mut best: Option<(i64, i64, usize, u16, Rows<A>)> = None;
    for (at, stage) in numbered(stages.iter()) {
        let current = stage.item(items, stage.best);
        for (index, item) in numbered(stage.items(items)) {
            let after = slack.plus(&current.rows()).minus(&item.rows());
            let removed = before.saturating_sub(violation(&after, slack));
            if removed <= 0 {
                continue;
            }
            let reduced_cost = difference(item.reduced_cost(), current.reduced_cost()).max(0);
            let better = best.is_none_or(|(least, most, ..)| {
                product(reduced_cost, most) < product(least, removed)
                    || (reduced_cost == 0 && least == 0 && removed > most)
            });
            if better {
                best = Some((reduced_cost, removed, at, index as u16, after));
            }
        }
    }
    let (_, _, at, index, after) = best?;
    stages.get_mut(at)?.best = index;
    Some(after)
}

/// Makes the one switch within the slack that gains the most value; `None` when none gains.
fn improve<const A: usize>(
    items: &[Item<A>],
    stages: &mut [Stage<A>],
    slack: &Rows<A>,
) -> Option<Rows<A>> {
    let mut best: Option<(u32, usize, u16, Rows<A>)> = None;
    for (at, stage) in numbered(stages.iter()) {
        let current = stage.item(items, stage.best);
        for (index, item) in numbered(stage.items(items)) {
            let Some(gain) = item.value.checked_sub(current.value) else { continue };
            if gain == 0 || best.is_some_and(|(most, ..)| gain <= most) {
                continue;
            }
            let after = slack.plus(&current.rows()).minus(&item.rows());
            if after.none_negative() {
                best = Some((gain, at, index as u16, after));
            }
        }
    }
    let (_, at, index, after) = best?;
    stages.get_mut(at)?.best = index;
    Some(after)
}
