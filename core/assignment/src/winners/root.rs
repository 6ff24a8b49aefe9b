//! The bound over all coalitions, of which none is listed.

use super::first::First;
use super::oracle::Oracle;
use super::prices::Dual;
use super::{Budget, FAR, LIMIT, PlanEntry, Slot, at, bits, put};

/// The bound over all coalitions.
pub(super) struct Root<'r, const N: usize> {
    pub(super) plans: &'r [PlanEntry],
    pub(super) rows: &'r [[i64; N]],
    pub(super) keep: i64,
    pub(super) slots: &'r mut [Slot],
    pub(super) oracle: &'r mut Oracle<N>,
    pub(super) robots: usize,
    /// The cost of the best solution so far.
    pub(super) best: &'r mut i64,
    pub(super) calls: u32,
}

impl<const N: usize> Dual<N> for Root<'_, N> {
    fn evaluate(
        &mut self,
        prices: &[i64; N],
        wanted: &mut [i64; N],
        budget: &mut Budget,
    ) -> Option<i64> {
        budget.take((self.rows.len() as u64).wrapping_add(1))?;
        debug_assert!(prices.iter().all(|it| *it >= 0), "any prices from 0 on give a bound");
        self.slots.iter_mut().for_each(|it| (it.least, it.common) = (it.skip, 0));
        for plan in self.plans {
            let rows = plan.rows(self.rows);
            let Some(slot) = self.slots.get_mut(usize::from(plan.task)).filter(|it| !it.idle)
            else {
                continue;
            };
            if let Some((value, set)) = self.oracle.cheapest(plan, rows, self.keep, prices)
                && value < slot.least
            {
                (slot.least, slot.common) = (value, set);
            }
        }
        *wanted = [0; N];
        let mut bound = 0_i64;
        for slot in self.slots.iter() {
            if slot.least >= LIMIT {
                return Some(FAR);
            }
            bound = bound.wrapping_add(slot.least);
            for robot in bits(slot.common) {
                let count = at(&*wanted, robot).wrapping_add(1);
                put(wanted, robot, count);
            }
        }
        wanted.iter_mut().skip(self.robots).for_each(|it| *it = 1);
        let bound = prices.iter().take(self.robots).fold(bound, |sum, it| sum.wrapping_sub(*it));
        if self.calls.is_multiple_of(8) {
            let Self { plans, rows, keep, .. } = *self;
            let mut first = First { plans, rows, keep, slots: self.slots, oracle: self.oracle };
            if let Some(cost) = first.draft(prices, budget)
                && cost < *self.best
            {
                first.accept();
                *self.best = cost;
            }
        }
        self.calls = self.calls.wrapping_add(1);
        Some(bound)
    }
}
