//! The caller's memory for one candidate.

use super::rows::{Rows, difference};

/// Working memory for one candidate. Give [`Exact::new`](super::Exact::new) one for each candidate
/// of the problem.
#[derive(Clone, Copy, Debug)]
pub struct Item<const A: usize> {
    /// Cost above the cheapest of the activity.
    pub(super) cost: [u32; A],
    /// Quality below the best of the activity, where an objective before fixed the quality.
    pub(super) deficit: u32,
    /// Value above the least of the activity.
    pub(super) value: u32,
    /// The reduced cost in 48 bits, and the position among the candidates as written in 16.
    packed: u64,
}

/// Bits of a reduced cost that are not kept; a reduced cost is rounded down, so that no plan is
/// excluded.
const GRAIN: u32 = 4;
/// Bits of an item's position among the candidates as written.
const CHOICE: u32 = u16::BITS;

impl<const A: usize> Item<A> {
    /// Unused memory.
    pub const EMPTY: Self = Self { cost: [0; A], deficit: 0, value: 0, packed: 0 };
    pub(super) const NONE: &'static Self = &Self::EMPTY;

    pub(super) const fn new(cost: [u32; A], deficit: u32, value: u32, choice: u16) -> Self {
        Self { cost, deficit, value, packed: choice as u64 }
    }

    #[inline]
    pub(super) fn rows(&self) -> Rows<A> {
        Rows { axes: self.cost.map(i64::from), quality: i64::from(self.deficit) }
    }

    /// The value at these prices, with `fraction` fraction bits.
    #[inline]
    pub(super) fn reduced(&self, multiplier: &Rows<A>, fraction: u32) -> i64 {
        difference(i64::from(self.value).wrapping_shl(fraction), multiplier.dot(&self.rows()))
    }

    /// Returns the reduced cost: the difference at the current prices to the best item of the
    /// activity. One of 2^52 or more, which no plan within any allowance has, is kept as the
    /// largest below.
    #[inline]
    pub(super) const fn reduced_cost(&self) -> i64 {
        ((self.packed >> CHOICE) << GRAIN).cast_signed()
    }

    /// Sets the reduced cost, which is not negative.
    pub(super) fn set_reduced_cost(&mut self, reduced_cost: i64) {
        debug_assert!(reduced_cost >= 0, "no item is better than the best of its activity");
        let kept = (reduced_cost.cast_unsigned() >> GRAIN).min(u64::MAX >> CHOICE);
        self.packed = kept << CHOICE | u64::from(self.choice());
    }

    /// Position among the candidates as written.
    #[inline]
    pub(super) const fn choice(&self) -> u16 {
        self.packed as u16
    }
}
