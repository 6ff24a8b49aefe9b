//! A bound from remainders, for problems where many activities share a ratio of value to cost.
//!
//! Choices that lose next to nothing at the dual prices often change the value by multiples of one number only: nine
//! per 100 mm, say. Then every plan near the bound has the remainder of the best items, unless activities are
//! changed at a real loss. The least loss for each remainder is a shortest path over as many nodes as there are
//! remainders (the group relaxation of Gomory 1965, with the value as its one row); the bound falls to the next
//! value whose remainder can be paid for.

use super::dual::Price;
use super::load::Frame;
use super::{Item, Stage};

/// The most remainders kept.
const REMAINDERS: usize = 64;
/// A loss below this part of one unit of value, as a shift, counts as next to none.
const NEXT_TO_NONE: u32 = 5;

/// The largest value, `bound` at most, that the remainders allow. Needs losses, and each activity's best item first.
pub(super) fn bound<const A: usize>(
    frame: &Frame<A>,
    price: &Price<A>,
    items: &[Item<A>],
    stages: &[Stage<A>],
    bound: i64,
) -> i64 {
    let small = (1i64 << frame.fraction) >> NEXT_TO_NONE;
    let (mut divisor, mut base) = (0, 0);
    for own in stages.iter().map(|stage| stage.items(items)) {
        base += i64::from(own[0].value);
        for item in own[1..].iter().take_while(|item| item.loss <= small) {
            divisor = gcd(divisor, item.value.abs_diff(own[0].value));
        }
    }
    let Some(modulus) = (2..=REMAINDERS as u32).rev().find(|&m| divisor > 0 && divisor.is_multiple_of(m))
    else {
        return bound;
    };

    // What may be lost by a plan worth a whole unit less than all remainders below the bound.
    let modulus = i64::from(modulus);
    let most = price.bound - ((bound - modulus) << frame.fraction);
    let mut least = [i64::MAX; REMAINDERS];
    let place = |value: i64| value.rem_euclid(modulus).unsigned_abs() as usize;
    least[0] = 0;
    for own in stages.iter().map(|stage| stage.items(items)) {
        let before = least;
        for item in own[1..].iter().take_while(|item| item.loss <= most) {
            let step = i64::from(item.value) - i64::from(own[0].value);
            if place(step) == 0 {
                continue;
            }
            for (from, &loss) in (0..modulus).zip(&before) {
                let to = place(from + step);
                least[to] = least[to].min(loss.saturating_add(item.loss));
            }
        }
    }
    let paid = |value: &i64| least[place(value - base)] <= price.bound - (value << frame.fraction);
    (bound - modulus..=bound).rev().find(paid).unwrap_or(bound - modulus)
}

const fn gcd(mut a: u32, mut b: u32) -> u32 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}
