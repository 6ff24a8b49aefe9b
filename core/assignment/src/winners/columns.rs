//! All coalitions that can be part of a better solution, listed.
//!
//! At prices that give the bound, each coalition has a reduced cost: by how much it pays more than
//! the best one of its task. A solution costs the bound and the reduced costs of its coalitions at
//! least, so one that costs at most so much more than the bound is made of coalitions within that
//! reduced cost. They are found as K. G. Murty ranks assignments (Operations Research 16, 1968):
//! the best coalition, then for each of its robots the best one without it that has the robots
//! before it.

use super::oracle::{Oracle, restricted};
use super::{Budget, Column, FAR, NO_PLAN, PlanEntry, Slot, bits, plans_of};
use crate::RobotSet;

/// A set of coalitions of one plan, not yet looked at.
#[derive(Clone, Copy, Debug)]
pub struct Open {
    /// All have these robots.
    forced: RobotSet,
    /// Robots that no coalition may have.
    banned: RobotSet,
}

impl Open {
    /// Unused memory.
    pub const EMPTY: Self = Self { forced: 0, banned: 0 };
}

/// The materials from which coalitions are listed.
pub(super) struct Listing<'l, const N: usize> {
    pub(super) plans: &'l [PlanEntry],
    pub(super) rows: &'l [[i64; N]],
    pub(super) keep: i64,
    pub(super) slots: &'l [Slot],
    pub(super) prices: &'l [i64; N],
    pub(super) open: &'l mut [Open],
}

impl<const N: usize> Listing<'_, N> {
    /// Lists the coalitions within this reduced cost, task after task, and returns how many there
    /// are; none where memory lacks or the budget ends.
    pub(super) fn list(
        &mut self,
        oracle: &mut Oracle<N>,
        reduced_cost: i64,
        columns: &mut [Column],
        budget: &mut Budget,
    ) -> Option<usize> {
        debug_assert!(reduced_cost >= 0, "the coalitions that give the bound are within any");
        let mut count = 0_usize;
        for (task, slot) in (0..self.slots.len() as u16).zip(self.slots) {
            let limit = slot.least.saturating_add(reduced_cost);
            if slot.skip <= limit {
                let none = Column { set: 0, cost: slot.skip, task, plan: NO_PLAN };
                *columns.get_mut(count)? = none;
                count = count.wrapping_add(1);
            }
            let plans = if slot.idle { &[] } else { plans_of(self.plans, usize::from(task)) };
            for plan in plans {
                count = self.list_plan(oracle, plan, limit, columns, count, budget)?;
            }
        }
        Some(count)
    }

    /// Lists the coalitions of one plan.
    fn list_plan(
        &mut self,
        oracle: &mut Oracle<N>,
        plan: &PlanEntry,
        limit: i64,
        columns: &mut [Column],
        mut count: usize,
        budget: &mut Budget,
    ) -> Option<usize> {
        let rows = plan.rows(self.rows);
        if let [row] = rows {
            budget.take(1)?;
            for (robot, (entry, price)) in (0..N as u32).zip(row.iter().zip(self.prices)) {
                let cost = (entry & self.keep).wrapping_add(plan.extra & self.keep);
                if cost.wrapping_add(*price) <= limit {
                    let set = 1_u128.wrapping_shl(robot);
                    *columns.get_mut(count)? = plan.column(set, cost);
                    count = count.wrapping_add(1);
                }
            }
            return Some(count);
        }
        let mut left = 1_usize;
        *self.open.get_mut(0)? = Open::EMPTY;
        while let Some(last) = left.checked_sub(1) {
            left = last;
            let Open { forced, banned } = self.open.get(left).copied()?;
            budget.take(rows.len() as u64)?;
            let prices = restricted(self.prices, banned, forced);
            let Some((value, set)) = oracle.cheapest(plan, rows, self.keep, &prices) else {
                continue;
            };
            debug_assert_eq!(set & banned, 0, "no robot is taken that is banned");
            if set & forced != forced {
                continue;
            }
            let paid = |prices: &[i64; N]| {
                bits(set)
                    .map(|it| prices.get(it).copied().unwrap_or(FAR))
                    .fold(0, i64::wrapping_add)
            };
            let cost = value.wrapping_sub(paid(&prices));
            debug_assert!(cost >= 0, "no coalition gains by itself");
            if cost.wrapping_add(paid(self.prices)) > limit {
                continue;
            }
            *columns.get_mut(count)? = plan.column(set, cost);
            count = count.wrapping_add(1);
            let mut with = forced;
            for robot in bits(set & !forced) {
                let bit = 1_u128.wrapping_shl(robot as u32);
                *self.open.get_mut(left)? = Open { forced: with, banned: banned | bit };
                left = left.wrapping_add(1);
                with |= bit;
            }
        }
        Some(count)
    }
}
