//! First solutions: tasks choose one after another at the current prices; then pairs of tasks
//! exchange robots.

use super::oracle::{Oracle, restricted};
use super::{Budget, FAR, LIMIT, NO_PLAN, PlanEntry, Slot, at, bits, disjoint, plans_of};
use crate::RobotSet;

/// So many tasks that are looked at are a step.
const LOOKS: u64 = 64;

/// The materials from which solutions are made.
pub(super) struct First<'f, const N: usize> {
    pub(super) plans: &'f [PlanEntry],
    pub(super) rows: &'f [[i64; N]],
    pub(super) keep: i64,
    pub(super) slots: &'f mut [Slot],
    pub(super) oracle: &'f mut Oracle<N>,
}

/// The choice of a task.
#[derive(Clone, Copy)]
struct Choice {
    set: RobotSet,
    plan: u16,
    cost: i64,
}

impl<const N: usize> First<'_, N> {
    /// The best choice of a task at these prices, without the robots that are taken; none where it
    /// must be done and cannot.
    fn choose(&mut self, task: usize, prices: &[i64; N], taken: RobotSet) -> Option<Choice> {
        let slot = self.slots.get(task)?;
        let mut best = Choice { set: 0, plan: NO_PLAN, cost: slot.skip };
        let mut least = slot.skip;
        let own = restricted(prices, taken, 0);
        let plans = if slot.idle { &[] } else { plans_of(self.plans, task) };
        for plan in plans {
            let rows = plan.rows(self.rows);
            let Some((value, set)) = self.oracle.cheapest(plan, rows, self.keep, &own) else {
                continue;
            };
            if value < least {
                let paid = bits(set).map(|it| at(&own, it)).fold(0, i64::wrapping_add);
                best = Choice { set, plan: plan.number, cost: value.wrapping_sub(paid) };
                least = value;
            }
        }
        (least < LIMIT).then_some(best)
    }

    /// A solution in the drafts, by rising prices of what a task pays; its cost.
    ///
    /// A task that must be done and finds no robots comes first the next time.
    pub(super) fn draft(&mut self, prices: &[i64; N], budget: &mut Budget) -> Option<i64> {
        self.slots.iter_mut().for_each(|it| it.rank = it.least.min(LIMIT));
        for _ in 0..self.slots.len().min(12) {
            budget.take(self.rows.len() as u64)?;
            match self.try_draft(prices, budget)? {
                Ok(cost) => return Some(cost),
                Err(failed) => {
                    let most = self.slots.iter().map(|it| it.rank).fold(0, i64::max);
                    if let Some(slot) = self.slots.get_mut(failed) {
                        slot.rank = most.saturating_add(1);
                    }
                }
            }
        }
        None
    }

    /// The cost of the draft, or the task that finds no robots; nothing where the budget ends.
    fn try_draft(&mut self, prices: &[i64; N], budget: &mut Budget) -> Option<Result<i64, usize>> {
        let (mut taken, mut cost): (RobotSet, i64) = (0, 0);
        self.slots.iter_mut().for_each(|it| it.draft_cost = FAR);
        // The next task is looked for among all of them.
        let looks = self.slots.len() as u64 / LOOKS;
        loop {
            budget.take(looks)?;
            if taken.count_ones() as usize >= self.oracle.robots {
                return Some(self.leave_undone(cost));
            }
            let open = (0..self.slots.len()).zip(self.slots.iter());
            let open = open.filter(|it| it.1.draft_cost == FAR);
            let next = open.max_by_key(|(number, it)| (it.rank, core::cmp::Reverse(*number)));
            let Some((task, _)) = next else { return Some(Ok(cost)) };
            let Some(choice) = self.choose(task, prices, taken) else { return Some(Err(task)) };
            debug_assert_eq!(taken & choice.set, 0, "no robot is in two tasks");
            (taken, cost) = (taken | choice.set, cost.wrapping_add(choice.cost));
            self.put(task, choice);
        }
    }

    /// No robot is left: what is open is left undone. The cost, or the first task that must be
    /// done.
    fn leave_undone(&mut self, cost: i64) -> Result<i64, usize> {
        let open = (0..self.slots.len()).zip(self.slots.iter());
        let must = open.filter(|it| it.1.draft_cost == FAR && it.1.skip >= LIMIT);
        let first = must.max_by_key(|(number, it)| (it.rank, core::cmp::Reverse(*number)));
        if let Some((task, _)) = first {
            return Err(task);
        }
        let mut cost = cost;
        for slot in self.slots.iter_mut().filter(|it| it.draft_cost == FAR) {
            (slot.draft, slot.draft_plan, slot.draft_cost) = (0, NO_PLAN, slot.skip);
            cost = cost.wrapping_add(slot.skip);
        }
        Ok(cost)
    }

    fn put(&mut self, task: usize, choice: Choice) {
        debug_assert!(task < self.slots.len(), "a task");
        if let Some(slot) = self.slots.get_mut(task) {
            (slot.draft, slot.draft_plan, slot.draft_cost) = (choice.set, choice.plan, choice.cost);
        }
    }

    /// The best solution becomes the draft, and its pairs of tasks exchange robots; its cost.
    pub(super) fn improve(&mut self, budget: &mut Budget) -> Option<i64> {
        self.recall();
        self.exchange(budget)
    }

    /// The best solution becomes the draft; its cost.
    pub(super) fn recall(&mut self) -> i64 {
        let mut sum = 0_i64;
        for task in 0..self.slots.len() {
            let Some(slot) = self.slots.get(task).copied() else { continue };
            let mut choice = Choice { set: 0, plan: NO_PLAN, cost: slot.skip };
            let plans = plans_of(self.plans, task);
            if let Some(plan) = plans.iter().find(|it| it.number == slot.plan) {
                let only = restricted(&[0; N], !slot.chosen, 0);
                let rows = plan.rows(self.rows);
                if let Some((cost, set)) = self.oracle.cheapest(plan, rows, self.keep, &only) {
                    choice = Choice { set, plan: plan.number, cost };
                }
            }
            self.put(task, choice);
            sum = sum.wrapping_add(choice.cost);
        }
        sum
    }

    /// Pairs of tasks of the draft give back their robots and choose anew, one after the other,
    /// until no pair gains; the cost of the draft afterwards.
    fn exchange(&mut self, budget: &mut Budget) -> Option<i64> {
        let none = [0; N];
        let mut taken = self.slots.iter().fold(0, |set, it| set | it.draft);
        for _ in 0..4 {
            let mut gained = false;
            for one in 0..self.slots.len() {
                for other in 0..one {
                    budget.take(4)?;
                    if let Some(set) = self.exchange_two(one, other, &none, taken) {
                        (gained, taken) = (true, set);
                    }
                }
            }
            if !gained {
                break;
            }
        }
        Some(self.slots.iter().map(|it| it.draft_cost).fold(0, i64::wrapping_add))
    }

    /// Two tasks choose anew; the robots that are taken afterwards, if it gained anything.
    fn exchange_two(
        &mut self,
        one: usize,
        other: usize,
        prices: &[i64; N],
        all: RobotSet,
    ) -> Option<RobotSet> {
        let (first, second) = (*self.slots.get(one)?, *self.slots.get(other)?);
        if first.draft | second.draft == 0 {
            return None;
        }
        // No robot is in two tasks.
        let taken = all & !(first.draft | second.draft);
        let now = first.draft_cost.wrapping_add(second.draft_cost);
        for (one, other) in [(one, other), (other, one)] {
            let Some(a) = self.choose(one, prices, taken) else { continue };
            if a.cost >= now {
                continue;
            }
            let Some(b) = self.choose(other, prices, taken | a.set) else { continue };
            debug_assert_eq!(
                taken & a.set | (taken | a.set) & b.set,
                0,
                "no robot is in two tasks"
            );
            if a.cost.wrapping_add(b.cost) < now {
                self.put(one, a);
                self.put(other, b);
                return Some(taken | a.set | b.set);
            }
        }
        None
    }

    /// The draft becomes the best solution.
    pub(super) fn accept(&mut self) {
        debug_assert!(disjoint(self.slots.iter().map(|it| it.draft)), "no robot is in two tasks");
        for slot in self.slots.iter_mut() {
            (slot.chosen, slot.plan) = (slot.draft, slot.draft_plan);
        }
    }
}
