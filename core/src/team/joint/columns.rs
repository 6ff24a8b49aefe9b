//! All coalitions that can be part of a better solution, listed.
//!
//! At prices that give the bound, each coalition has a loss against the best one of its task; a
//! solution costs the bound and the losses of its coalitions at least. So a solution that costs at
//! most `loss` more than the bound is made of coalitions within that loss. They are found as K. G.
//! Murty ranks assignments (Operations Research 16, 1968): the best coalition, then for each of its
//! robots the best one without it that has the robots before it.

use super::oracle::{Oracle, restricted};
use super::{Budget, Column, FAR, NO_PLAN, Slot, Way, bits};
use crate::team::RobotSet;

/// A set of coalitions of one plan, not yet looked at.
#[derive(Clone, Copy, Debug)]
pub struct Open {
    /// All have these robots.
    forced: RobotSet,
    /// None has one of these.
    banned: RobotSet,
}

impl Open {
    /// Unused memory.
    pub const EMPTY: Self = Self { forced: 0, banned: 0 };
}

/// What coalitions are listed from.
pub(super) struct Listing<'l, const N: usize> {
    pub(super) ways: &'l [Way],
    pub(super) rows: &'l [[i64; N]],
    pub(super) keep: i64,
    pub(super) slots: &'l [Slot],
    pub(super) prices: &'l [i64; N],
    pub(super) open: &'l mut [Open],
}

impl<const N: usize> Listing<'_, N> {
    /// Lists the coalitions within this loss, task after task, and returns how many there are; none
    /// where memory lacks or the budget ends.
    pub(super) fn list(
        &mut self,
        oracle: &mut Oracle<N>,
        loss: i64,
        columns: &mut [Column],
        budget: &mut Budget,
    ) -> Option<usize> {
        let mut count = 0_usize;
        for (task, slot) in (0..self.slots.len() as u16).zip(self.slots) {
            let limit = slot.least.saturating_add(loss);
            if slot.skip <= limit {
                let none = Column { set: 0, cost: slot.skip, task, plan: NO_PLAN };
                *columns.get_mut(count)? = none;
                count = count.wrapping_add(1);
            }
            let ways = self.ways.iter().filter(|it| it.task == task && !slot.idle);
            for way in ways {
                count = self.list_way(oracle, way, limit, columns, count, budget)?;
            }
        }
        Some(count)
    }

    /// Lists the coalitions of one plan.
    fn list_way(
        &mut self,
        oracle: &mut Oracle<N>,
        way: &Way,
        limit: i64,
        columns: &mut [Column],
        mut count: usize,
        budget: &mut Budget,
    ) -> Option<usize> {
        let rows = way.rows(self.rows);
        if let [row] = rows {
            budget.take(1)?;
            for (robot, (entry, price)) in (0..N as u32).zip(row.iter().zip(self.prices)) {
                let cost = (entry & self.keep).wrapping_add(way.extra & self.keep);
                if cost.wrapping_add(*price) <= limit {
                    let set = 1_u128.wrapping_shl(robot);
                    *columns.get_mut(count)? = way.column(set, cost);
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
            let Some((value, set)) = oracle.cheapest(way, rows, self.keep, &prices) else {
                continue;
            };
            if set & forced != forced {
                continue;
            }
            let paid = |prices: &[i64; N]| {
                bits(set)
                    .map(|it| prices.get(it).copied().unwrap_or(FAR))
                    .fold(0, i64::wrapping_add)
            };
            let cost = value.wrapping_sub(paid(&prices));
            if cost.wrapping_add(paid(self.prices)) > limit {
                continue;
            }
            *columns.get_mut(count)? = way.column(set, cost);
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
