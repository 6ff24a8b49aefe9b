//! The bounds of a level of the search and the levels behind it.
//!
//! A node is bounded at several multipliers (value per unit of a row): the best ones, at which its
//! reduced cost says all, and for each row those with this row dearer or cheaper. A node that has
//! run short of a row is excluded by the dearer ones, a node that has left too much of it by the
//! cheaper ones. With *y = step * (what is left of the row)* the first are two steps above the
//! best, the second one step below, so that one product prices both.

use super::congruence::Remainders;
use super::dual::Price;
use super::item::Item;
use super::level::Rest;
use super::load::Frame;
use super::memory::Stage;
use super::rows::{Rows, difference, product, sum};

/// How far the prices of each row are moved to price nodes anew.
pub(super) fn steps<const A: usize>(frame: &Frame<A>, price: &Price<A>) -> Rows<A> {
    let room = frame.most_multiplier.minus(&price.multiplier);
    debug_assert!(room.none_negative() && price.multiplier.none_negative(), "priced sums fit");
    // Twice a step more is at most the largest multiplier.
    frame.most_multiplier.zip(&price.multiplier, |most, best| best.min(difference(most, best)) / 2)
}

/// Fills the bounds of the levels, from the last one back. Returns how much of each row they can
/// save together, against their best items, and what else they can do.
pub(super) fn prepare<const A: usize>(
    items: &[Item<A>],
    stages: &mut [Stage<A>],
    steps: &Rows<A>,
    none: &Remainders,
    (levels, allowance, fraction): (usize, i64, u32),
) -> (Rows<A>, Rest<A>) {
    let mut saving = Rows::ZERO;
    let mut rest = Rest::NONE;
    let mut remainders = *none;
    let price = |rows: &Rows<A>| steps.zip(rows, product);
    for depth in (0..levels).rev() {
        let at = stages.get(depth).map_or(0, |it| it.level.stage);
        debug_assert!(usize::from(at) < stages.len(), "a level is that of an activity");
        let Some(stage) = stages.get(usize::from(at)) else { break };
        let (first, base) = (stage.first, stage.best);
        let own = stage.items(items);
        debug_assert!(own.is_sorted_by_key(Item::reduced_cost), "the least reduced cost first");
        let Some(best) = own.first() else { break };
        let (best_value, best) = (best.value, best.rows());
        let mut least = best;
        let mut more = price(&best).zip(&best, |price, _| product(price, -2));
        let mut less = price(&best);
        let (mut count, mut most_value) = (0u16, best_value);
        for item in own.iter().take_while(|item| item.reduced_cost() <= allowance) {
            let (rows, reduced_cost) = (item.rows(), item.reduced_cost());
            let price = price(&rows);
            least = least.zip(&rows, i64::min);
            more = more
                .zip(&price, |most, price| most.max(difference(product(price, -2), reduced_cost)));
            less = less.zip(&price, |most, price| most.max(difference(price, reduced_cost)));
            most_value = most_value.max(item.value);
            count = count.wrapping_add(1);
        }
        debug_assert!(count > 0, "the best item is within the allowance");
        let floor = price(&least);
        rest.residues = remainders.residues(allowance, fraction);
        let Some(Stage { level, .. }) = stages.get_mut(depth) else { break };
        (level.first, level.count) = (first, count);
        // One that loses too much is not visited.
        level.base = if base < count { base } else { 0 };
        level.least = least.axes.map(|least| least.unsigned_abs() as u32);
        level.least_deficit = least.quality.unsigned_abs() as u32;
        level.best_value = best_value;
        level.rest = rest;
        rest.value = sum(rest.value, most_value.wrapping_sub(best_value).into());
        rest.dearer = rest.dearer.plus(&more).plus(&floor).plus(&floor);
        rest.cheaper = rest.cheaper.plus(&less).minus(&floor);
        saving = saving.plus(&best).minus(&least);
        if remainders.matter() {
            remainders = remainders.with(own, allowance);
        }
    }
    debug_assert!(saving.none_negative(), "no level takes more at its least than at its best item");
    rest.residues = remainders.residues(allowance, fraction);
    (saving, rest)
}
