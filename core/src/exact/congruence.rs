//! A bound from remainders, for problems where many activities share a ratio of value to cost.
//!
//! Choices that lose next to nothing at the dual prices often change the value by multiples of one
//! number only: nine per 100 mm, say. Then every plan near the bound has the remainder of the best
//! items, unless activities are changed at a real loss. The least loss for each remainder is a
//! shortest path over as many nodes as there are remainders (the group relaxation of Gomory 1965,
//! with the value as its one row); the bound falls to the next value whose remainder can be paid
//! for.

use super::dual::Price;
use super::load::Frame;
use super::{Item, Stage};
use core::num::NonZero;

/// The most remainders kept.
pub(super) const REMAINDERS: usize = 16;
/// A loss below this part of one unit of value, as a shift, counts as next to none.
const NEXT_TO_NONE: u32 = 5;
/// A loss that no plan can pay.
const NEVER: i64 = i64::MAX;

/// The least loss at which some activities change the value by each remainder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Remainders {
    modulus: NonZero<u32>,
    least: [i64; REMAINDERS],
}

impl Remainders {
    /// No remainders: every value can be reached.
    pub(super) const NONE: Self = Self { modulus: NonZero::<u32>::MIN, least: [0; REMAINDERS] };

    /// The remainders of no activity at all, modulo the number that choices near the bound have in
    /// common. Needs losses, and each activity's best item first.
    pub(super) fn of<const A: usize>(
        frame: &Frame<A>,
        items: &[Item<A>],
        stages: &[Stage<A>],
    ) -> Self {
        let small = frame.priced(1) >> NEXT_TO_NONE;
        let mut divisor = 0;
        for own in stages.iter().map(|stage| stage.items(items)) {
            let [best, others @ ..] = own else { continue };
            for item in others.iter().take_while(|item| item.loss <= small) {
                divisor = gcd(divisor, item.value.abs_diff(best.value));
            }
        }
        let common = (2..=REMAINDERS as u32)
            .rev()
            .filter_map(NonZero::new)
            .find(|&m| divisor > 0 && divisor % m == 0);
        let mut least = [NEVER; REMAINDERS];
        least[0] = 0;
        common.map_or(Self::NONE, |modulus| Self { modulus, least })
    }

    /// Whether there is anything to gain from remainders.
    pub(super) const fn matter(&self) -> bool {
        self.modulus.get() > 1
    }

    fn place(&self, value: i64) -> usize {
        value.rem_euclid(i64::from(self.modulus.get())).unsigned_abs() as usize
    }

    /// The least loss for the remainder at this place.
    fn loss(&self, place: usize) -> i64 {
        self.least.get(place).copied().unwrap_or(NEVER)
    }

    /// The same with one more activity, whose items lose at most `most`.
    pub(super) fn with<const A: usize>(&self, own: &[Item<A>], most: i64) -> Self {
        let mut next = *self;
        let [best, others @ ..] = own else { return next };
        let modulus = self.modulus.get() as usize;
        for item in others.iter().take_while(|item| item.loss <= most) {
            let step = self.place(i64::from(item.value).wrapping_sub(i64::from(best.value)));
            if step == 0 {
                continue;
            }
            for (from, &loss) in self.least.iter().enumerate().take(modulus) {
                let sum = from.wrapping_add(step);
                let to = if sum < modulus { sum } else { sum.wrapping_sub(modulus) };
                if let Some(least) = next.least.get_mut(to) {
                    *least = (*least).min(loss.saturating_add(item.loss));
                }
            }
        }
        next
    }

    /// Whether a plan worth `worth` can be changed by these activities into one worth `target` or
    /// more, when a plan worth `target` may lose `allowance` in all. Each unit of value has
    /// `fraction` bits.
    pub(super) fn reach(&self, worth: i64, target: i64, mut allowance: i64, fraction: u32) -> bool {
        let modulus = self.modulus.get() as usize;
        let mut place = self.place(target.wrapping_sub(worth));
        for _ in 0..modulus {
            if allowance < 0 {
                return false;
            }
            if self.loss(place) <= allowance {
                return true;
            }
            allowance = allowance.wrapping_sub(1i64.wrapping_shl(fraction));
            place = place.wrapping_add(1);
            if place == modulus {
                place = 0;
            }
        }
        false
    }
}

/// The largest value, `bound` at most, that the remainders allow.
pub(super) fn bound<const A: usize>(
    frame: &Frame<A>,
    price: &Price<A>,
    items: &[Item<A>],
    stages: &[Stage<A>],
    none: &Remainders,
    bound: i64,
) -> i64 {
    // What may be lost by a plan worth less than all remainders below the bound.
    let lowest = bound.wrapping_sub(i64::from(none.modulus.get()));
    let allowance = |value: i64| price.bound.wrapping_sub(frame.priced(value));
    let mut all = *none;
    let mut base = 0i64;
    for own in stages.iter().map(|stage| stage.items(items)) {
        base = base.wrapping_add(own.first().map_or(0, |best| i64::from(best.value)));
        all = all.with(own, allowance(lowest));
    }
    let paid = |&value: &i64| all.loss(all.place(value.wrapping_sub(base))) <= allowance(value);
    (lowest..=bound).rev().find(paid).unwrap_or(lowest)
}

const fn gcd(mut a: u32, mut b: u32) -> u32 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}
