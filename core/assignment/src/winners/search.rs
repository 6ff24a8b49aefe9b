//! The best choice of listed coalitions, one a task, no robot in two: branch and bound on an
//! explicit stack.
//!
//! A node is a list of coalitions. Its bound comes from prices of robots; what cannot be part of a
//! better solution at these prices leaves the list. Then a task either needs a robot, and no other
//! task may have it, or does without it.

use super::prices::{Dual, Until, ascend};
use super::{Budget, Column, FAR, LIMIT, Slot, at, bits, put};
use crate::RobotSet;

/// A node whose second half waits; as many as there are robots, and one more.
#[derive(Clone, Copy, Debug)]
pub struct Level<const N: usize> {
    /// Bounds of its list of coalitions.
    first: u32,
    end: u32,
    /// The task that does without a robot in the second half.
    task: u16,
    robot: u8,
    /// Bound of the node and its prices.
    bound: i64,
    prices: [i64; N],
}

impl<const N: usize> Level<N> {
    /// Unused memory.
    pub const EMPTY: Self = Self { first: 0, end: 0, task: 0, robot: 0, bound: 0, prices: [0; N] };
}

/// A search under plan.
pub(super) struct Search<'s, const N: usize> {
    pub(super) columns: &'s mut [Column],
    pub(super) slots: &'s mut [Slot],
    pub(super) levels: &'s mut [Level<N>],
    pub(super) robots: usize,
    /// See [`Until::gap`].
    pub(super) gap: i64,
    /// The cost of the best solution so far; all costs differ by multiples of `step`.
    pub(super) best: i64,
    pub(super) step: i64,
    /// Whether a solution was found; it is in the slots.
    pub(super) found: bool,
    pub(super) nodes: u64,
    /// The best prices for the whole list.
    pub(super) prices: [i64; N],
}

/// The list of a node, as the bound is evaluated with.
struct List<'n> {
    columns: &'n [Column],
    slots: &'n mut [Slot],
    robots: usize,
}

/// The next step with a node.
enum Next {
    /// Nothing better is in it.
    Closed,
    /// Does this task need this robot?
    Ask(u16, usize),
}

impl<const N: usize> Dual<N> for List<'_> {
    fn evaluate(
        &mut self,
        prices: &[i64; N],
        wanted: &mut [i64; N],
        budget: &mut Budget,
    ) -> Option<i64> {
        budget.take((self.columns.len() as u64 / 8).wrapping_add(1))?;
        debug_assert!(prices.iter().all(|it| *it >= 0), "any prices from 0 on give a bound");
        self.slots.iter_mut().for_each(|it| (it.least, it.column) = (FAR, u32::MAX));
        for (number, column) in (0..self.columns.len() as u32).zip(self.columns) {
            let value = column.value(prices);
            if let Some(slot) = self.slots.get_mut(usize::from(column.task))
                && value < slot.least
            {
                (slot.least, slot.column) = (value, number);
            }
        }
        *wanted = [0; N];
        let mut bound = 0_i64;
        for slot in self.slots.iter() {
            let Some(column) = self.columns.get(slot.column as usize) else { return Some(FAR) };
            bound = bound.wrapping_add(slot.least);
            for robot in bits(column.set) {
                let count = at(&*wanted, robot).wrapping_add(1);
                put(wanted, robot, count);
            }
        }
        wanted.iter_mut().skip(self.robots).for_each(|it| *it = 1);
        Some(prices.iter().take(self.robots).fold(bound, |sum, it| sum.wrapping_sub(*it)))
    }
}

impl<const N: usize> Search<'_, N> {
    /// Searches the first `count` columns for a solution of less than the best cost. Says what no
    /// unexamined solution among them undercuts: the best cost if all were examined.
    pub(super) fn run(&mut self, count: usize, prices: &[i64; N], budget: &mut Budget) -> i64 {
        debug_assert!(count <= self.columns.len(), "the columns are listed");
        let (mut depth, mut first, mut end) = (0_usize, 0_usize, count);
        let (mut prices, mut bound) = (*prices, i64::MIN);
        let mut lost = i64::MAX; // the least bound of a node that memory lacked for
        let mut root = true;
        loop {
            self.nodes = self.nodes.wrapping_add(1);
            let next = self.node(first, &mut end, &mut prices, &mut bound, root, budget);
            if root {
                (self.prices, root) = (prices, false);
            }
            let Some(next) = next else {
                let waiting = self.levels.iter().take(depth).map(|it| it.bound);
                return waiting.chain([bound, lost]).fold(self.best, i64::min);
            };
            let mut open = None;
            if let Next::Ask(task, robot) = next {
                let whole = (first, end);
                if let Some(copied) = self.with_robot(whole, task, robot)
                    && let Some(level) = self.levels.get_mut(depth)
                {
                    let robot = robot as u8;
                    let (first, end) = (first as u32, end as u32);
                    *level = Level { first, end, task, robot, bound, prices };
                    depth = depth.wrapping_add(1);
                    open = Some((whole.1, copied));
                } else {
                    lost = lost.min(bound);
                }
            }
            while open.is_none() {
                // The second half of the last node, unless it has become hopeless.
                let Some(level) = depth.checked_sub(1).and_then(|it| self.levels.get(it)) else {
                    return lost.min(self.best);
                };
                depth = depth.wrapping_sub(1);
                if level.bound > self.best.saturating_sub(self.step) {
                    continue;
                }
                (prices, bound) = (level.prices, level.bound);
                let list = (level.first as usize, level.end as usize);
                let (task, bit) = (level.task, 1_u128.wrapping_shl(u32::from(level.robot)));
                let without = |it: &Column| it.task != task || it.set & bit == 0;
                open = Some((list.0, self.retain(list, without)));
            }
            if let Some(open) = open {
                (first, end) = open;
            }
        }
    }

    /// Copies what is left of a list where this task needs this robot behind the list; its end.
    fn with_robot(&mut self, list: (usize, usize), task: u16, robot: usize) -> Option<usize> {
        debug_assert!(robot < self.robots, "a robot of the team");
        debug_assert!(list.0 <= list.1 && list.1 <= self.columns.len(), "a list of columns");
        let bit = 1_u128.wrapping_shl(robot as u32);
        let mut end = list.1;
        for number in list.0..list.1 {
            let column = self.columns.get(number).copied()?;
            if (column.task == task) == (column.set & bit != 0) {
                *self.columns.get_mut(end)? = column;
                end = end.wrapping_add(1);
            }
        }
        Some(end)
    }

    /// Keeps some columns of a list; its new end.
    fn retain(&mut self, list: (usize, usize), keep: impl Fn(&Column) -> bool) -> usize {
        debug_assert!(list.0 <= list.1 && list.1 <= self.columns.len(), "a list of columns");
        let mut end = list.0;
        for number in list.0..list.1 {
            if let Some(column) = self.columns.get(number).copied().filter(&keep) {
                put(self.columns, end, column);
                end = end.wrapping_add(1);
            }
        }
        end
    }

    /// Bounds a node, shortens its list and says how to go on; none where the budget ends.
    fn node(
        &mut self,
        first: usize,
        end: &mut usize,
        prices: &mut [i64; N],
        bound: &mut i64,
        root: bool,
        budget: &mut Budget,
    ) -> Option<Next> {
        let mut wanted = [0; N];
        let mut evaluations = if root { 200_u32 } else { 24 };
        loop {
            let enough = self.best.saturating_sub(self.step).saturating_add(1);
            debug_assert!(first <= *end && *end <= self.columns.len(), "a list of columns");
            let columns = self.columns.get(first..*end).unwrap_or(&[]);
            let mut list = List { columns, slots: self.slots, robots: self.robots };
            let robots = self.robots;
            let until = Until {
                enough,
                evaluations,
                target: self.best,
                robots,
                gap: self.gap.max(self.best),
            };
            let found = ascend(&mut list, prices, until, budget)?;
            *bound = found.max(*bound);
            if *bound >= enough {
                return Some(Next::Closed);
            }
            let here = list.evaluate(prices, &mut wanted, budget)?;
            self.note(first);
            let room = self.best.saturating_sub(self.step).saturating_sub(here);
            let before = *end;
            *end = self.within(first, before, prices, room);
            let length = |end: usize| end.wrapping_sub(first);
            let most = length(before).wrapping_mul(4);
            if length(*end).wrapping_mul(5) >= most || evaluations < 6 {
                break;
            }
            evaluations = (evaluations / 2).wrapping_add(2);
        }
        let enough = self.best.saturating_sub(self.step).saturating_add(1);
        let columns = self.columns.get(first..*end).unwrap_or(&[]);
        let mut list = List { columns, slots: self.slots, robots: self.robots };
        let here = list.evaluate(prices, &mut wanted, budget)?;
        if here >= enough {
            return Some(Next::Closed);
        }
        self.note(first);
        Some(self.ask(first, *end, prices, &wanted))
    }

    /// Keeps the columns within this reduced cost, and of robots that a task cannot do without only
    /// that task's.
    fn within(&mut self, first: usize, end: usize, prices: &[i64; N], room: i64) -> usize {
        let mut end = end;
        let mut kept = first;
        for number in first..end {
            let Some(column) = self.columns.get(number).copied() else { continue };
            let least = self.slots.get(usize::from(column.task)).map_or(FAR, |it| it.least);
            debug_assert!(least <= column.value(prices), "the least of a task is noted");
            if column.value(prices).saturating_sub(least) <= room {
                put(self.columns, kept, column);
                kept = kept.wrapping_add(1);
            }
        }
        end = end.min(kept);
        loop {
            // The robots that all columns of a task have in common.
            self.slots.iter_mut().for_each(|it| it.common = RobotSet::MAX);
            for column in self.columns.get(first..end).unwrap_or(&[]) {
                if let Some(slot) = self.slots.get_mut(usize::from(column.task)) {
                    slot.common &= column.set;
                }
            }
            let all = self.slots.iter().filter(|it| it.common != RobotSet::MAX);
            let needed = all.fold(0, |set, it| set | it.common);
            let mut kept = first;
            for number in first..end {
                let Some(column) = self.columns.get(number).copied() else { continue };
                let own = self.slots.get(usize::from(column.task)).map_or(0, |it| it.common);
                if column.set & needed & !own == 0 {
                    put(self.columns, kept, column);
                    kept = kept.wrapping_add(1);
                }
            }
            if kept == end {
                return end;
            }
            end = kept;
        }
    }

    /// The cheapest columns at these prices are a solution if no robot is in two: notes it, if it
    /// is better.
    fn note(&mut self, first: usize) {
        let (mut taken, mut cost): (RobotSet, i64) = (0, 0);
        let place = |slot: &Slot| first.wrapping_add(slot.column as usize);
        for slot in self.slots.iter() {
            let Some(column) = self.columns.get(place(slot)) else { return };
            if column.set & taken != 0 {
                return;
            }
            (taken, cost) = (taken | column.set, cost.wrapping_add(column.cost));
        }
        debug_assert_eq!(cost % self.step, 0, "costs differ by multiples of a step");
        if cost < self.best {
            (self.best, self.found) = (cost, true);
            for slot in self.slots.iter_mut() {
                if let Some(column) = self.columns.get(place(slot)) {
                    (slot.chosen, slot.plan) = (column.set, column.plan);
                }
            }
        }
    }

    /// The question whose weaker answer costs most: whether a task needs a robot that several want.
    fn ask(&mut self, first: usize, end: usize, prices: &[i64; N], wanted: &[i64; N]) -> Next {
        let columns = self.columns.get(first..end).unwrap_or(&[]);
        let mut best: Option<(i64, u16, usize)> = None;
        for robot in (0..self.robots).filter(|it| at(wanted, *it) > 1) {
            let bit = 1_u128.wrapping_shl(robot as u32);
            self.slots.iter_mut().for_each(|it| it.without = FAR);
            for column in columns.iter().filter(|it| it.set & bit == 0) {
                if let Some(slot) = self.slots.get_mut(usize::from(column.task)) {
                    slot.without = slot.without.min(column.value(prices));
                }
            }
            let wants = |slot: &&Slot| {
                columns.get(slot.column as usize).is_some_and(|it| it.set & bit != 0)
            };
            let regret = |slot: &Slot| slot.without.min(LIMIT).saturating_sub(slot.least);
            let all = self.slots.iter().filter(wants).map(regret).fold(0, i64::saturating_add);
            let slots = (0..self.slots.len() as u16).zip(self.slots.iter());
            for (task, slot) in slots.filter(|it| wants(&it.1)) {
                let own = regret(slot);
                let weaker = own.min(all.saturating_sub(own));
                if best.is_none_or(|it| weaker > it.0) {
                    best = Some((weaker, task, robot));
                }
            }
        }
        if let Some((_, task, robot)) = best {
            return Next::Ask(task, robot);
        }
        // Nobody wants the same, and it is not known to be best: the nearest other choice.
        let mut nearest: Option<(i64, u16, usize)> = None;
        for (number, column) in (0..columns.len() as u32).zip(columns) {
            let Some(slot) = self.slots.get(usize::from(column.task)) else { continue };
            let Some(own) = columns.get(slot.column as usize).filter(|_| slot.column != number)
            else {
                continue;
            };
            let reduced_cost = column.value(prices).saturating_sub(slot.least);
            let Some(robot) = bits(column.set ^ own.set).next() else { continue };
            if nearest.is_none_or(|it| reduced_cost < it.0) {
                nearest = Some((reduced_cost, column.task, robot));
            }
        }
        nearest.map_or(Next::Closed, |(_, task, robot)| Next::Ask(task, robot))
    }
}
