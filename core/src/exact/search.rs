//! Depth-first search for a plan within a given loss of the bound, the loss rising until one is found.
//!
//! At the dual prices a plan is worth *bound - sum of losses - price of its slack*. To be worth at least a
//! target, losses and slack together may use up to *allowance = bound - target*; items whose own loss exceeds
//! it cannot be in such a plan (reduced-cost fixing), and activities with one item left need no level.

use super::dual::Price;
use super::load::Frame;
use super::rows::Rows;
use super::{Budget, Item, REPRICINGS, Stage};

/// Searches until the best plan meets the bound, nothing is left, or the budget is spent. Takes the value of the
/// plan in [`Stage::best`], if there is one, and returns the new one and whether the search was complete.
/// `bound` is lowered to what is proven.
pub(super) fn search<const A: usize>(
    frame: &Frame<A>,
    price: &Price<A>,
    items: &[Item<A>],
    stages: &mut [Stage<A>],
    mut best: Option<i64>,
    bound: &mut i64,
    budget: &mut Budget,
) -> (Option<i64>, bool) {
    let multipliers = repricings(frame, price);
    let mut width = 0;
    loop {
        // A plan worth the bound, or every plan excluded.
        let floor = best.map_or(0, |value| value + 1);
        if *bound < floor {
            return (best, true);
        }
        let target = (*bound - width).max(floor);
        let mut dive = Dive { frame, price, items, stages, multipliers: &multipliers, target, levels: 0 };
        dive.prepare();
        let Some(found) = dive.run(budget) else {
            // Stopped: what was found on the way is a plan, the bound stays.
            if dive.target > target {
                best = Some(dive.target - 1);
            }
            return (best, false);
        };
        if found {
            best = Some(dive.target - 1);
            *bound = dive.target - 1;
            return (best, true);
        }
        *bound = target - 1;
        width += width / 2 + 1;
    }
}

/// The multipliers that price nodes anew: the best ones with one row dearer or cheaper. A node that has run
/// short of a row is excluded by the dearer one, a node that has left too much of it by the cheaper one.
fn repricings<const A: usize>(frame: &Frame<A>, price: &Price<A>) -> [Rows<A>; REPRICINGS] {
    let mut multipliers = [price.multiplier; REPRICINGS];
    let binding = (0..Rows::<A>::COUNT).filter(|&row| frame.most_multiplier.get(row) > 0);
    for (row, pair) in binding.zip(multipliers.chunks_exact_mut(2)) {
        let best = price.multiplier.get(row);
        pair[0].set(row, best.saturating_mul(2).min(frame.most_multiplier.get(row)));
        pair[1].set(row, best / 2);
    }
    multipliers
}

struct Dive<'d, const A: usize> {
    frame: &'d Frame<A>,
    price: &'d Price<A>,
    items: &'d [Item<A>],
    stages: &'d mut [Stage<A>],
    multipliers: &'d [Rows<A>; REPRICINGS],
    /// The value looked for; one above the best found once one is found.
    target: i64,
    levels: usize,
}

impl<const A: usize> Dive<'_, A> {
    /// What losses and priced slack may use up together.
    fn allowance(&self) -> i64 {
        self.price.bound - (self.target << self.frame.fraction)
    }

    /// Makes the levels: activities with several items within the allowance, the costliest to change first,
    /// since a change there leaves little for the others. Fills their bounds from the last one back.
    fn prepare(&mut self) {
        let allowance = self.allowance();
        self.levels = 0;
        for at in 0..self.stages.len() {
            self.stages[at].current = 0;
            let own = self.stages[at].items(self.items);
            if own.get(1).is_some_and(|item| item.loss <= allowance) {
                self.stages[self.levels].level.stage = at as u32;
                self.levels += 1;
            }
        }
        for top in (0..self.levels / 2).rev() {
            self.sift(top, self.levels);
        }
        for end in (1..self.levels).rev() {
            self.swap_levels(0, end);
            self.sift(0, end);
        }

        let mut saving = Rows::ZERO;
        let mut gain = [0; REPRICINGS];
        for level in (0..self.levels).rev() {
            let stage = &self.stages[self.stages[level].level.stage as usize];
            let own = stage.items(self.items);
            let best = &own[0];
            let mut most = Rows::<A>::ZERO;
            let mut gained = [0; REPRICINGS];
            for item in own.iter().take_while(|item| item.loss <= allowance) {
                most = most.zip(&best.rows().minus(&item.rows()), i64::max);
                for (gained, multiplier) in gained.iter_mut().zip(self.multipliers) {
                    let fraction = self.frame.fraction;
                    *gained = (*gained)
                        .max(item.reduced(multiplier, fraction) - best.reduced(multiplier, fraction));
                }
            }
            saving = saving.plus(&most);
            for (sum, part) in gain.iter_mut().zip(gained) {
                *sum += part;
            }
            let level = &mut self.stages[level].level;
            level.saving = saving;
            level.gain = gain;
        }
    }

    /// The loss of the second item of a level's activity: what a change there costs at least.
    fn change(&self, level: usize) -> (i64, core::cmp::Reverse<u32>) {
        let stage = self.stages[level].level.stage;
        (self.stages[stage as usize].item(self.items, 1).loss, core::cmp::Reverse(stage))
    }

    fn swap_levels(&mut self, a: usize, b: usize) {
        let first = self.stages[a].level.stage;
        self.stages[a].level.stage = self.stages[b].level.stage;
        self.stages[b].level.stage = first;
    }

    /// One sift of a heap sort with the least change on top, which leaves the levels in falling order.
    fn sift(&mut self, mut top: usize, end: usize) {
        loop {
            let mut least = top;
            for child in [2 * top + 1, 2 * top + 2] {
                if child < end && self.change(child) < self.change(least) {
                    least = child;
                }
            }
            if least == top {
                return;
            }
            self.swap_levels(top, least);
            top = least;
        }
    }

    /// Whether a node, with this slack and loss before level `depth`, can lead to the target.
    #[inline]
    fn promising(&self, depth: usize, slack: &Rows<A>, loss: i64) -> bool {
        let allowance = self.allowance();
        if loss > allowance {
            return false;
        }
        if depth == self.levels {
            return slack.none_negative() && self.price.multiplier.dot(slack) + loss <= allowance;
        }
        let level = &self.stages[depth].level;
        if !slack.plus(&level.saving).none_negative() {
            return false;
        }
        // value + multiplier * slack + gain >= target, with value = bound - loss - best multiplier * slack
        self.multipliers.iter().zip(&level.gain).all(|(multiplier, gain)| {
            multiplier.minus(&self.price.multiplier).dot(slack) + gain >= loss - allowance
        })
    }

    /// Visits every promising node; `Some(found)` when complete, `None` when the budget ended it.
    fn run(&mut self, budget: &mut Budget) -> Option<bool> {
        let mut slack = self.frame.room;
        for stage in self.stages.iter() {
            slack = slack.minus(&stage.item(self.items, 0).rows());
        }
        let mut found = false;
        let mut loss = 0;
        let mut depth = 0;
        budget.take(1)?;
        if !self.promising(0, &slack, loss) {
            return Some(false);
        }
        let mut entering = true;
        loop {
            if entering && depth == self.levels {
                self.keep(&slack, loss);
                found = true;
                entering = false;
                if depth == 0 {
                    return Some(true);
                }
                depth -= 1;
                continue;
            }
            if entering {
                let level = &mut self.stages[depth].level;
                (level.cursor, level.slack, level.loss) = (0, slack, loss);
            } else {
                self.stages[depth].level.cursor += 1;
            }
            let level = self.stages[depth].level;
            let stage = self.stages[level.stage as usize];
            let own = stage.items(self.items);
            let within =
                own.get(level.cursor as usize).filter(|item| level.loss + item.loss <= self.allowance());
            let Some(item) = within else {
                self.stages[level.stage as usize].current = 0;
                if depth == 0 {
                    return Some(found);
                }
                depth -= 1;
                entering = false;
                continue;
            };
            budget.take(1)?;
            let (next_slack, next_loss) =
                (level.slack.plus(&own[0].rows()).minus(&item.rows()), level.loss + item.loss);
            entering = self.promising(depth + 1, &next_slack, next_loss);
            if entering {
                self.stages[level.stage as usize].current = level.cursor;
                (slack, loss) = (next_slack, next_loss);
                depth += 1;
            }
        }
    }

    /// Keeps the plan under work as the best and raises the target above it.
    fn keep(&mut self, slack: &Rows<A>, loss: i64) {
        let worth = self.price.bound - loss - self.price.multiplier.dot(slack);
        debug_assert!(worth & ((1 << self.frame.fraction) - 1) == 0, "a plan is worth a whole number");
        self.target = (worth >> self.frame.fraction) + 1;
        for stage in self.stages.iter_mut() {
            stage.best = stage.current;
        }
    }
}
