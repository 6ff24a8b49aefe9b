//! From a team to an answer: the bound, first solutions, and ever larger reduced costs.

use super::answer::{Outcome, Solved, WinnersMemory};
use super::columns::Listing;
use super::first::First;
use super::oracle::{Oracle, restricted};
use super::prices::{Dual, Until, ascend};
use super::root::Root;
use super::search::Search;
use super::{Budget, FAR, LIMIT, NO_PLAN, at, disjoint, plans_of};
use crate::{RobotSet, Team};
use cotama_units::memory::MemoryError;

/// Assigns all tasks of a team at once. With feature `alloc`, a `Workspace` provides the memory.
///
/// ```
/// use cotama_core::team::winners::{Outcome, Workspace};
/// use cotama_core::team::{Combine, Cost, Costs, Plan, Task, Team};
///
/// // The first robot is best for both tasks, and the only one that can weld.
/// let (lift, weld) = ([Cost::new(1), Cost::new(2)], [Cost::new(5), None]);
/// let plan = |costs| [Plan { roles: Costs::new(costs, 2).unwrap(), extra: 0 }];
/// let plans = [plan(&lift), plan(&weld)];
/// let task = |plans| Task { skip: None, combine: Combine::Sum, plans };
/// let tasks = [task(&plans[0]), task(&plans[1])];
/// let team = Team::new(2, 1, &tasks).unwrap();
///
/// let mut workspace = Workspace::<2>::new();
/// let mut winners = workspace.winners(&team, 64);
/// assert_eq!(winners.solve(&team, 10_000).unwrap().outcome, Outcome::Optimal { cost: 7 });
/// assert_eq!((winners.chosen(0), winners.chosen(1)), (Some((0, 0b10)), Some((0, 0b01))));
/// assert!(winners.robots(1).eq([0]));
/// ```
#[derive(Debug)]
pub struct Winners<'m, const N: usize> {
    pub(super) memory: WinnersMemory<'m, N>,
    pub(super) oracle: Oracle<N>,
    /// How many tasks, plans and roles there are.
    pub(super) tasks: usize,
    pub(super) plans: usize,
    pub(super) roles: usize,
    pub(super) robots: usize,
    /// All costs are computed with times two to this.
    pub(super) shift: u32,
    /// All costs differ by multiples of this.
    pub(super) step: i64,
    /// Mask of a cost: all of it counts, or only whether it is missing.
    pub(super) keep: i64,
    /// The best solution costs this; as much as `ceiling`, that none costs, if none is known.
    pub(super) best: i64,
    pub(super) ceiling: i64,
    /// See [`Until::gap`].
    pub(super) gap: i64,
    pub(super) nodes: u64,
    /// Robots that tasks in conflict compete for.
    pub(super) contested: RobotSet,
}

/// Without costs, a task that is left undone costs this.
const UNSERVED: i64 = 1 << 20;

impl<'m, const N: usize> Winners<'m, N> {
    /// With this memory.
    pub const fn new(memory: WinnersMemory<'m, N>) -> Self {
        Self {
            memory,
            oracle: Oracle::EMPTY,
            tasks: 0,
            plans: 0,
            roles: 0,
            robots: 0,
            shift: 0,
            step: 1,
            keep: !0,
            best: 0,
            ceiling: 0,
            gap: 0,
            nodes: 0,
            contested: 0,
        }
    }

    /// Assigns the tasks within so many steps.
    ///
    /// # Errors
    /// [`MemoryError`] where memory does not suffice for the team.
    pub fn solve(&mut self, team: &Team<'_>, steps: u64) -> Result<Solved, MemoryError> {
        self.load(team)?;
        let mut budget = Budget { left: steps };
        let outcome = self.run(&mut budget);
        Ok(Solved { outcome, steps: steps.saturating_sub(budget.left), nodes: self.nodes })
    }

    /// The plan of a task in the last answer, and its robots; none where it is left undone.
    pub fn chosen(&self, task: usize) -> Option<(usize, RobotSet)> {
        let slot = self.memory.slots.get(..self.tasks)?.get(task)?;
        (slot.plan != NO_PLAN).then_some((usize::from(slot.plan), slot.chosen))
    }

    /// The robot of each role of a task in the last answer, in the order of the roles.
    pub fn robots(&mut self, task: usize) -> impl Iterator<Item = usize> {
        let chosen = self.chosen(task);
        let roles = chosen.and_then(|(plan, set)| {
            let plans = plans_of(self.memory.plans.get(..self.plans)?, task);
            let plan = plans.iter().find(|it| usize::from(it.number) == plan)?;
            let rows = plan.rows(self.memory.roles);
            self.oracle.cheapest(plan, rows, !0, &restricted(&[0; N], !set, 0))?;
            Some(rows.len())
        });
        (0..roles.unwrap_or(0)).filter_map(|role| self.oracle.robot(role))
    }

    /// Whether a task is one of those that cannot be staffed together.
    pub fn in_conflict(&self, task: usize) -> bool {
        self.memory
            .slots
            .get(..self.tasks)
            .and_then(|it| it.get(task))
            .is_some_and(|it| it.conflict)
    }

    fn run(&mut self, budget: &mut Budget) -> Outcome {
        let mut prices = [0; N];
        let Some(mut bound) = self.bound(&mut prices, 24, budget) else {
            return self.unknown(0);
        };
        if self.infeasible(false, budget) {
            return Outcome::Infeasible { robots: self.contested };
        }
        if bound >= LIMIT {
            return self.unknown(0);
        }
        if let Some(it) = self.bound(&mut prices, 240, budget) {
            bound = bound.max(it);
        }
        if bound < self.ceiling && self.infeasible(true, budget) {
            return Outcome::Infeasible { robots: self.contested };
        }
        // The payments of tasks at these prices are needed again.
        if self.bound(&mut prices, 1, budget).is_none() {
            return self.unknown(bound);
        }
        self.exchange(budget);
        // `bound` is proven, `value` is what the prices prove; a reduced cost is above that.
        let mut value = bound;
        let mut most = 128_usize.saturating_mul(self.tasks);
        let gap = self.best.saturating_sub(bound);
        let mut rise = (bound >> 6).max(gap >> 5).max(self.step);
        let mut last = 0;
        loop {
            let solved = self.best < self.ceiling;
            debug_assert!(!solved || bound <= self.best, "no solution is below the bound");
            debug_assert!(value <= bound, "the bound is what is proven, by prices or otherwise");
            let rest = self.best.saturating_sub(self.step);
            if rest < bound {
                return self.proven();
            }
            let limit = bound.saturating_add(rise).min(rest);
            let Some(count) = self.list(&prices, limit.saturating_sub(value), most, budget) else {
                if rise > (bound >> 9).max(self.step) {
                    rise /= 2;
                } else if most < self.memory.columns.len() / 2 && budget.left > 0 {
                    most = most.saturating_mul(4);
                } else {
                    return self.unknown(bound);
                }
                continue;
            };
            let before = self.nodes;
            let mut other = prices;
            let (found, open) = self.search(count, limit, &mut other, budget);
            if open <= limit && open < self.best {
                return self.unknown(open.max(bound));
            }
            if found {
                return self.proven();
            }
            bound = limit.saturating_add(1);
            rise = match self.nodes.wrapping_sub(before) {
                _ if count == last => rise.saturating_mul(8), // all there is, it seems
                ..=2 => rise.saturating_mul(2),
                _ => rise.saturating_add(rise / 4),
            };
            last = count;
            most = most.saturating_mul(2);
            // Prices that were good for the list may be so for all coalitions.
            if let Some(it) = self.bound(&mut other, 20, budget)
                && it > value
            {
                (prices, value) = (other, it);
            } else if self.bound(&mut prices, 1, budget).is_none() {
                return self.unknown(bound);
            }
            bound = bound.max(value);
        }
    }

    /// Raises the bound over all coalitions from these prices on.
    fn bound(&mut self, prices: &mut [i64; N], count: u32, budget: &mut Budget) -> Option<i64> {
        let memory = &mut self.memory;
        let mut best = self.best;
        let mut root = Root {
            plans: memory.plans.get(..self.plans).unwrap_or(&[]),
            rows: memory.roles.get(..self.roles).unwrap_or(&[]),
            keep: self.keep,
            slots: memory.slots.get_mut(..self.tasks).unwrap_or(&mut []),
            oracle: &mut self.oracle,
            robots: self.robots,
            best: &mut best,
            calls: 0,
        };
        let enough = self.best.saturating_sub(self.step.wrapping_sub(1));
        let until = Until {
            enough,
            evaluations: count,
            target: self.best,
            robots: self.robots,
            gap: self.gap,
        };
        let bound = ascend(&mut root, prices, until, budget);
        // The payments of tasks at the best prices.
        let again = root.evaluate(prices, &mut [0; N], budget);
        self.best = best;
        again.and(bound)
    }

    /// Exchanges robots between pairs of tasks of the best solution.
    fn exchange(&mut self, budget: &mut Budget) {
        if self.best == self.ceiling {
            return;
        }
        let best = self.best;
        let mut first = self.first();
        if let Some(cost) = first.improve(budget)
            && cost < best
        {
            first.accept();
            self.best = cost;
        }
    }

    /// Lists all coalitions within a reduced cost.
    fn list(
        &mut self,
        prices: &[i64; N],
        reduced_cost: i64,
        most: usize,
        budget: &mut Budget,
    ) -> Option<usize> {
        let memory = &mut self.memory;
        let mut listing = Listing {
            plans: memory.plans.get(..self.plans).unwrap_or(&[]),
            rows: memory.roles.get(..self.roles).unwrap_or(&[]),
            keep: self.keep,
            slots: memory.slots.get(..self.tasks).unwrap_or(&[]),
            prices,
            open: memory.open,
        };
        // Half of the memory is for the search.
        let most = most.min(memory.columns.len() / 2);
        let columns = memory.columns.get_mut(..most).unwrap_or(&mut []);
        listing.list(&mut self.oracle, reduced_cost, columns, budget)
    }

    /// Searches for a solution of at most `limit`; whether one was found, and what no solution that
    /// was not looked at undercuts.
    fn search(
        &mut self,
        count: usize,
        limit: i64,
        prices: &mut [i64; N],
        budget: &mut Budget,
    ) -> (bool, i64) {
        let memory = &mut self.memory;
        let mut search = Search {
            columns: memory.columns,
            slots: memory.slots.get_mut(..self.tasks).unwrap_or(&mut []),
            levels: memory.levels,
            robots: self.robots,
            gap: self.gap,
            best: self.best.min(limit.saturating_add(self.step)),
            step: self.step,
            found: false,
            nodes: 0,
            prices: *prices,
        };
        let open = search.run(count, prices, budget);
        let (found, best) = (search.found, search.best);
        self.nodes = self.nodes.wrapping_add(search.nodes);
        *prices = search.prices;
        if found {
            self.best = best;
        }
        (found, open)
    }

    /// Whether the tasks that must be done cannot be staffed together: the same problem without
    /// costs, where each of them that is left undone costs something; by the bound, or by a search
    /// too. A solution that serves all is kept. Takes an eighth of the budget at most.
    fn infeasible(&mut self, search: bool, budget: &mut Budget) -> bool {
        let must = self.memory.slots.iter().take(self.tasks).any(|it| it.must);
        if self.best < self.ceiling || !must {
            return false;
        }
        let mut part = Budget { left: budget.left / 8 };
        budget.left = budget.left.saturating_sub(part.left);
        for slot in self.memory.slots.iter_mut().take(self.tasks) {
            slot.skip = if slot.must { UNSERVED } else { 0 };
            slot.idle = !slot.must;
        }
        let step = core::mem::replace(&mut self.step, UNSERVED);
        (self.keep, self.best) = (FAR, UNSERVED);
        let mut prices = [0; N];
        let proven = self.unserved(&mut prices, search, &mut part);
        budget.left = budget.left.saturating_add(part.left);
        let served = self.best < UNSERVED;
        (self.keep, self.step, self.best) = (!0, step, self.ceiling);
        self.gap = 0;
        for slot in self.memory.slots.iter_mut().take(self.tasks) {
            (slot.skip, slot.idle) = (slot.undone, false);
        }
        if served {
            self.best = self.first().recall();
        }
        proven
    }

    /// Whether some task that must be done is left undone in each solution, with those tasks
    /// marked.
    fn unserved(&mut self, prices: &mut [i64; N], search: bool, budget: &mut Budget) -> bool {
        let mut bound = 0;
        // Long strides at first.
        for gap in [UNSERVED, UNSERVED / 8, UNSERVED / 64] {
            self.gap = gap;
            let Some(it) = self.bound(prices, 100, budget) else { return false };
            bound = it;
            if bound > 0 || self.best < UNSERVED {
                break;
            }
        }
        self.gap = UNSERVED;
        let ray = bound > 0;
        if !ray {
            if self.best < UNSERVED || !search {
                return false;
            }
            let limit = UNSERVED - 1;
            let count = self.list(prices, limit.wrapping_sub(bound), usize::MAX, budget);
            let Some(count) = count else { return false };
            let (found, open) = self.search(count, limit, &mut { *prices }, budget);
            if found || open < UNSERVED {
                return false;
            }
        }
        self.name_conflict(ray.then_some(&*prices));
        true
    }

    /// Marks the tasks in conflict: those that pay, at prices that prove it, or all that must be
    /// done.
    fn name_conflict(&mut self, ray: Option<&[i64; N]>) {
        for slot in self.memory.slots.iter_mut().take(self.tasks) {
            slot.conflict = slot.must && (ray.is_none() || slot.least > 0);
        }
        // The tasks of the ray pay more than the prices of all robots together.
        let bit = |it: usize| 1_u128.wrapping_shl(it as u32);
        let priced = |it: &usize| ray.is_some_and(|prices| at(prices, *it) > 0);
        let priced = (0..self.robots).filter(priced).fold(0, |set, it| set | bit(it));
        // A robot that can do nothing in any of them competes for nothing, whatever its price.
        let slots = self.memory.slots.get(..self.tasks).unwrap_or(&[]);
        let plans = self.memory.plans.iter().take(self.plans);
        let plans =
            plans.filter(|it| slots.get(usize::from(it.task)).is_some_and(|it| it.conflict));
        let mut capable = 0;
        for row in plans.flat_map(|it| it.rows(self.memory.roles)) {
            let own = (0..self.robots).filter(|it| at(row, *it) < LIMIT);
            capable |= own.fold(0, |set, it| set | bit(it));
        }
        self.contested = if priced & capable == 0 { capable } else { priced & capable };
    }

    /// Returns the materials from which solutions are made.
    fn first(&mut self) -> First<'_, N> {
        let memory = &mut self.memory;
        First {
            plans: memory.plans.get(..self.plans).unwrap_or(&[]),
            rows: memory.roles.get(..self.roles).unwrap_or(&[]),
            keep: self.keep,
            slots: memory.slots.get_mut(..self.tasks).unwrap_or(&mut []),
            oracle: &mut self.oracle,
        }
    }

    /// No solution is better than the best.
    fn proven(&mut self) -> Outcome {
        if self.best < self.ceiling {
            debug_assert!(self.is_solution(), "the best solution is one");
            return Outcome::Optimal { cost: self.parts(self.best) };
        }
        self.name_conflict(None);
        Outcome::Infeasible { robots: self.contested }
    }

    /// Whether tasks that must be done have a plan, and no robot is in two tasks.
    fn is_solution(&self) -> bool {
        let slots = self.memory.slots.get(..self.tasks).unwrap_or(&[]);
        let served = slots.iter().all(|it| !it.must || it.plan != NO_PLAN);
        served && disjoint(slots.iter().map(|it| it.chosen))
    }

    fn parts(&self, cost: i64) -> u64 {
        debug_assert_eq!(cost % (1 << self.shift), 0, "a cost is a whole number of parts");
        cost.wrapping_shr(self.shift).max(0).cast_unsigned()
    }

    fn unknown(&self, bound: i64) -> Outcome {
        // Costs are multiples of a step: the bound rises to the next.
        let up = bound.max(0).wrapping_add(self.step).wrapping_sub(1);
        let up = up.wrapping_sub(up.checked_rem(self.step).unwrap_or(0));
        let cost = (self.best < self.ceiling).then(|| self.parts(self.best));
        Outcome::Unknown { cost, bound: self.parts(up) }
    }
}
