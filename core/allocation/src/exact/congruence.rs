//! A bound from remainders, for problems where many activities share a ratio of value to cost.
//!
//! Choices that lose next to nothing at the dual prices often change the value by multiples of one
//! number only: nine per 100 mm, say. Then every plan near the bound has the remainder of the best
//! items, unless activities are changed at a real reduced cost. The least reduced cost for each
//! remainder is a shortest path over as many nodes as there are remainders (the group relaxation of
//! Gomory 1965, with the value as its one row); the bound falls to the next value whose remainder
//! can be paid for.

use super::dual::Price;
use super::level::{REMAINDERS, Residues};
use super::load::Frame;
use super::rows::{difference, sum};
use super::{Item, Stage};
use core::num::NonZero;

/// A reduced cost below this part of one unit of value, as a shift, counts as next to none.
const NEXT_TO_NONE: u32 = 5;
/// A reduced cost that no plan can pay; others can be added to it.
const NEVER: i64 = 1 << 62;

/// The least reduced cost at which some activities change the value by each remainder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Remainders {
    modulus: NonZero<u32>,
    least: [i64; REMAINDERS],
}

impl Remainders {
    /// No remainders: every value can be reached.
    pub(super) const NONE: Self = Self { modulus: NonZero::<u32>::MIN, least: [0; REMAINDERS] };

    /// The remainders of no activity at all, modulo the number that choices near the bound have in
    /// common. Needs reduced costs, and each activity's best item first.
    pub(super) fn of<const A: usize>(
        frame: &Frame<A>,
        items: &[Item<A>],
        stages: &[Stage<A>],
    ) -> Self {
        let small = frame.priced(1) >> NEXT_TO_NONE;
        let mut divisor = 0;
        for own in stages.iter().map(|stage| stage.items(items)) {
            let [best, others @ ..] = own else { continue };
            for item in others.iter().take_while(|item| item.reduced_cost() <= small) {
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

    /// The least reduced cost for the remainder at this place.
    fn reduced_cost(&self, place: usize) -> i64 {
        debug_assert!(place < self.modulus.get() as usize, "a remainder");
        self.least.get(place).copied().unwrap_or(NEVER)
    }

    /// The same with one more activity, whose items lose at most `most`.
    pub(super) fn with<const A: usize>(&self, own: &[Item<A>], most: i64) -> Self {
        let mut next = *self;
        debug_assert!(own.is_sorted_by_key(Item::reduced_cost), "the least reduced cost first");
        let [best, others @ ..] = own else { return next };
        let modulus = self.modulus.get();
        let base = best.value % self.modulus;
        // Only the first item of each remainder counts: its reduced cost is the least. The best
        // item changes no remainder.
        let mut taken = 1u32;
        for item in others.iter().take_while(|item| item.reduced_cost() <= most) {
            let above = (item.value % self.modulus).wrapping_sub(base);
            let step = if above < modulus { above } else { above.wrapping_add(modulus) };
            debug_assert!(step < modulus, "a remainder");
            let bit = 1u32.wrapping_shl(step);
            if taken & bit > 0 {
                continue;
            }
            taken |= bit;
            let (step, modulus) = (step as usize, modulus as usize);
            for (from, &reduced_cost) in self.least.iter().enumerate().take(modulus) {
                let end = from.wrapping_add(step);
                let to = if end < modulus { end } else { end.wrapping_sub(modulus) };
                if let Some(least) = next.least.get_mut(to) {
                    *least = sum(reduced_cost, item.reduced_cost()).min(*least);
                }
            }
        }
        next
    }

    /// Returns the residues that a level keeps, where `allowance` is the largest reduced cost of a
    /// plan and each unit of value has `fraction` bits.
    pub(super) fn residues(&self, allowance: i64, fraction: u32) -> Residues {
        if !self.matter() {
            return Residues::NONE;
        }
        debug_assert!(allowance >= 0, "a plan at the target is within the bound");
        let (modulus, grain) = (self.modulus.get() as usize, grain(allowance));
        let mut residues = Residues::NONE;
        // More than what is lacking will do, and leaves less to lose. No change loses nothing.
        let mut above = 0i64;
        for (least, &reduced_cost) in
            residues.least.iter_mut().zip(&self.least).take(modulus).skip(1).rev()
        {
            above = sum(above, 1i64.wrapping_shl(fraction)).min(reduced_cost);
            *least = u16::try_from(above.wrapping_shr(grain)).unwrap_or(u16::MAX);
        }
        residues
    }

    /// Whether activities with these residues can add `lacking` or more to the value of a plan that
    /// may lose `left` if it gains just that, with the `grain` of the residues.
    #[inline]
    pub(super) fn reach(&self, residues: &Residues, lacking: i64, left: i64, grain: u32) -> bool {
        let least = residues.least.get(self.place(lacking));
        least.is_none_or(|&least| i64::from(least) <= left.wrapping_shr(grain))
    }
}

/// How many bits of a reduced cost its 16 bits leave out, so that no `allowance` or less comes near
/// the reduced cost that no plan can pay.
pub(super) const fn grain(allowance: i64) -> u32 {
    (i64::BITS - 15).saturating_sub(allowance.leading_zeros())
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
    debug_assert!(frame.priced(bound) <= price.bound, "the best items pay for their remainder");
    // The allowance of a plan whose value is below all remainders under the bound.
    let lowest = bound.wrapping_sub(i64::from(none.modulus.get()));
    let allowance = |value: i64| difference(price.bound, frame.priced(value));
    let mut all = *none;
    let mut base = 0i64;
    for own in stages.iter().map(|stage| stage.items(items)) {
        base = sum(base, own.first().map_or(0, |best| i64::from(best.value)));
        all = all.with(own, allowance(lowest));
    }
    let paid =
        |&value: &i64| all.reduced_cost(all.place(value.wrapping_sub(base))) <= allowance(value);
    let found = (lowest..=bound).rev().find(paid);
    debug_assert!(found.is_some(), "the best items pay for their own remainder");
    found.unwrap_or(lowest)
}

const fn gcd(mut a: u32, mut b: u32) -> u32 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}
