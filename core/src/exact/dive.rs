//! Depth-first search for a plan that is worth a target.
//!
//! At the dual prices a plan is worth *bound - sum of losses - price of its slack*. To be worth at
//! least the target, losses and slack together may use up to *allowance = bound - target*; items
//! whose own loss exceeds it cannot be in such a plan (reduced-cost fixing), and activities with
//! one item left need no level.

use super::congruence::Remainders;
use super::dual::Price;
use super::load::Frame;
use super::rows::Rows;
use super::{Budget, Item, Level, REPRICINGS, Seen, Stage};

/// A dive: some activities have a level each, the others keep the item that is their `current`.
pub(super) struct Dive<'d, const A: usize> {
    frame: &'d Frame<A>,
    price: &'d Price<A>,
    multipliers: &'d [Rows<A>; REPRICINGS],
    /// What these multipliers have over the best ones.
    dearer: [Rows<A>; REPRICINGS],
    /// The remainders of no level.
    no_remainders: &'d Remainders,
    items: &'d [Item<A>],
    stages: &'d mut [Stage<A>],
    seen: &'d mut [Seen<A>],
    /// The value looked for; one above the best found once one is found.
    pub(super) target: i64,
    levels: usize,
    /// Slack and loss with every level at its best item.
    root: Point<A>,
    /// Number of this dive, so that what an earlier one has seen is not taken for its own.
    number: u32,
    /// How much of `seen` is in use.
    noted: usize,
}

/// What a partial plan leaves, the open activities at their best items.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<const A: usize> {
    slack: Rows<A>,
    loss: i64,
}

impl<const A: usize> Point<A> {
    pub(super) const ZERO: Self = Self { slack: Rows::ZERO, loss: 0 };

    /// The point with `item` in place of `other`.
    #[inline]
    fn exchange(&self, other: &Item<A>, item: &Item<A>) -> Self {
        Self {
            slack: self.slack.plus(&other.rows()).minus(&item.rows()),
            loss: self.loss.wrapping_add(item.loss).wrapping_sub(other.loss),
        }
    }
}

/// Levels so near the end that looking a node up costs more than searching it.
const NOT_KEPT: usize = 4;

impl<'d, const A: usize> Dive<'d, A> {
    pub(super) fn new(
        frame: &'d Frame<A>,
        price: &'d Price<A>,
        multipliers: &'d [Rows<A>; REPRICINGS],
        no_remainders: &'d Remainders,
        items: &'d [Item<A>],
        stages: &'d mut [Stage<A>],
        seen: &'d mut [Seen<A>],
    ) -> Self {
        let root = Point { slack: frame.room, loss: 0 };
        let dearer = multipliers.map(|multiplier| multiplier.minus(&price.multiplier));
        Self {
            frame,
            price,
            multipliers,
            dearer,
            no_remainders,
            items,
            stages,
            seen,
            target: 0,
            levels: 0,
            root,
            number: 0,
            noted: 0,
        }
    }

    /// Notes nodes from now on, in room for those of a turn of this many steps: clearing more would
    /// cost more than it saves, and easy problems end before any pays.
    pub(super) fn remember(&mut self, steps: u64) {
        let room = usize::try_from(steps).unwrap_or(usize::MAX).min(self.seen.len());
        if room > self.noted {
            self.noted = room;
            self.seen.get_mut(..room).unwrap_or(&mut []).fill(Seen::EMPTY);
        }
    }

    pub(super) fn stages(&self) -> &[Stage<A>] {
        self.stages
    }

    /// What losses and priced slack may use up together.
    fn allowance(&self) -> i64 {
        self.price.bound.wrapping_sub(self.frame.priced(self.target))
    }

    /// Frees every activity.
    pub(super) fn free_all(&mut self) {
        let allowance = self.allowance();
        self.levels = 0;
        self.root = Point { slack: self.frame.room, loss: 0 };
        for at in 0..self.stages.len() {
            let Some(stage) = self.stages.get_mut(at) else { break };
            stage.current = 0;
            let own = stage.items(self.items);
            let best = own.first().unwrap_or(Item::NONE);
            self.root.slack = self.root.slack.minus(&best.rows());
            if own.get(1).is_some_and(|item| item.loss <= allowance) {
                self.free(at);
            }
        }
        self.prepare();
    }

    /// Puts every activity at the item of the best plan; returns what that plan leaves, and the
    /// activity that loses most in it.
    pub(super) fn settle(&mut self) -> (Point<A>, usize) {
        let mut home = Point { slack: self.frame.room, loss: 0 };
        let (mut worst, mut most) = (0, 0);
        for (at, stage) in self.stages.iter_mut().enumerate() {
            stage.current = stage.best;
            let item = stage.item(self.items, stage.best);
            home.slack = home.slack.minus(&item.rows());
            home.loss = home.loss.wrapping_add(item.loss);
            if item.loss > most {
                (worst, most) = (at, item.loss);
            }
        }
        (home, worst)
    }

    /// Frees an activity and a few more, drawn by `round`; the others keep the best plan, which
    /// leaves `home`.
    pub(super) fn free_some(&mut self, home: Point<A>, first: usize, count: usize, round: u64) {
        let allowance = self.allowance();
        self.levels = 0;
        self.root = home;
        for draw in 0..count as u64 {
            // A multiplicative hash (Knuth, The Art of Computer Programming 3, section 6.4).
            let mixed = (round << 8 | draw).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let at = match (draw, round & 1) {
                (0, 0) => first,
                _ => drawn(mixed, self.stages.len()),
            };
            let Some(stage) = self.stages.get(at) else { continue };
            let (own, best) = (stage.items(self.items), stage.item(self.items, stage.best));
            let taken = self.stages.iter().take(self.levels).any(|s| s.level.stage == at as u32);
            if !taken && own.get(1).is_some_and(|item| item.loss <= allowance) {
                self.root = self.root.exchange(best, stage.item(self.items, 0));
                if let Some(stage) = self.stages.get_mut(at) {
                    stage.current = 0;
                }
                self.free(at);
            }
        }
        self.prepare();
    }

    /// Gives an activity a level.
    fn free(&mut self, at: usize) {
        if let Some(stage) = self.stages.get_mut(self.levels) {
            stage.level.stage = at as u32;
            self.levels = self.levels.wrapping_add(1);
        }
    }

    fn level(&self, depth: usize) -> &Level<A> {
        &self.stages.get(depth).unwrap_or(Stage::NONE).level
    }

    /// The activity of a level.
    fn stage_of(&self, depth: usize) -> &Stage<A> {
        self.stages.get(self.level(depth).stage as usize).unwrap_or(Stage::NONE)
    }

    /// Puts the activities that were freed back to the best plan.
    pub(super) fn restore(&mut self) {
        for level in 0..self.levels {
            if let Some(stage) = self.stages.get_mut(self.level(level).stage as usize) {
                stage.current = stage.best;
            }
        }
    }

    /// Sorts the levels, the costliest to change first, since a change there leaves little for the
    /// others, and fills their bounds from the last one back.
    fn prepare(&mut self) {
        self.number = self.number.wrapping_add(1);
        let allowance = self.allowance();
        for top in (0..self.levels / 2).rev() {
            self.sift(top, self.levels);
        }
        for end in (1..self.levels).rev() {
            self.swap_levels(0, end);
            self.sift(0, end);
        }

        let fraction = self.frame.fraction;
        let mut saving = Rows::ZERO;
        let mut gain = [0i64; REPRICINGS];
        let mut remainders = *self.no_remainders;
        for level in (0..self.levels).rev() {
            let stage = self.stage_of(level);
            let own = stage.items(self.items);
            let best = own.first().unwrap_or(Item::NONE);
            let mut most = Rows::<A>::ZERO;
            let mut gained = [0; REPRICINGS];
            for item in own.iter().take_while(|item| item.loss <= allowance) {
                most = most.zip(&best.rows().minus(&item.rows()), i64::max);
                for (gained, multiplier) in gained.iter_mut().zip(self.multipliers) {
                    let more = item.reduced(multiplier, fraction);
                    *gained = more.wrapping_sub(best.reduced(multiplier, fraction)).max(*gained);
                }
            }
            saving = saving.plus(&most);
            if remainders.matter() {
                remainders = remainders.with(own, allowance);
            }
            for (sum, part) in gain.iter_mut().zip(gained) {
                *sum = sum.wrapping_add(part);
            }
            let base = stage.best;
            let Some(Stage { level, .. }) = self.stages.get_mut(level) else { break };
            (level.saving, level.gain, level.base) = (saving, gain, base);
            level.remainders = remainders;
        }
    }

    /// The loss of the second item of a level's activity: what a change there costs at least.
    fn change(&self, level: usize) -> (i64, core::cmp::Reverse<u32>) {
        let loss = self.stage_of(level).item(self.items, 1).loss;
        (loss, core::cmp::Reverse(self.level(level).stage))
    }

    fn swap_levels(&mut self, a: usize, b: usize) {
        if let Ok([a, b]) = self.stages.get_disjoint_mut([a, b]) {
            core::mem::swap(&mut a.level.stage, &mut b.level.stage);
        }
    }

    /// One sift of a heap sort with the least change on top, which leaves the levels in falling
    /// order.
    fn sift(&mut self, mut top: usize, end: usize) {
        loop {
            let mut least = top;
            let left = top.wrapping_mul(2).wrapping_add(1);
            for child in [left, left.wrapping_add(1)] {
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

    /// Whether a node before level `depth` can lead to the target.
    #[inline]
    fn promising(&self, depth: usize, point: &Point<A>) -> bool {
        let allowance = self.allowance();
        if point.loss > allowance {
            return false;
        }
        if depth == self.levels {
            let used = self.price.multiplier.dot(&point.slack).wrapping_add(point.loss);
            return point.slack.none_negative() && used <= allowance;
        }
        let level = self.level(depth);
        if !point.slack.plus(&level.saving).none_negative() {
            return false;
        }
        // value + multiplier * slack + gain >= target, with value = bound - loss - best multiplier
        // * slack
        let needed = point.loss.wrapping_sub(allowance);
        let priced = self
            .dearer
            .iter()
            .zip(&level.gain)
            .all(|(dearer, &gain)| dearer.dot(&point.slack).wrapping_add(gain) >= needed);
        let reach = |level: &Level<A>| {
            let left = allowance.wrapping_sub(point.loss);
            level.remainders.reach(self.worth(point), self.target, left, self.frame.fraction)
        };
        priced && (!level.remainders.matter() || reach(level))
    }

    /// The priced value of the plan that has the open activities at their best items.
    #[inline]
    fn priced(&self, point: &Point<A>) -> i64 {
        let slack = self.price.multiplier.dot(&point.slack);
        self.price.bound.wrapping_sub(point.loss).wrapping_sub(slack)
    }

    /// The value of the plan that has the open activities at their best items, within its limits or
    /// not.
    #[inline]
    fn worth(&self, point: &Point<A>) -> i64 {
        self.frame.whole(self.priced(point))
    }

    /// Whether a node at least as good was searched at this level before; if not, notes this one.
    ///
    /// The dynamic programme over the limits, as far as memory allows: of two partial plans over
    /// the same activities that are worth the same, the one with less slack in every row is not
    /// needed.
    #[inline]
    fn seen_before(&mut self, depth: usize, point: &Point<A>) -> bool {
        if self.noted == 0 || depth.saturating_add(NOT_KEPT) > self.levels {
            return false;
        }
        let worth = self.worth(point);
        let mixed = worth.cast_unsigned().wrapping_mul(0x9E37_79B9_7F4A_7C15)
            ^ (depth as u64).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let place = drawn(mixed.wrapping_mul(0x94D0_49BB_1331_11EB), self.noted);
        let Some(seen) = self.seen.get_mut(place) else { return false };
        let same = seen.dive == self.number && seen.depth == depth as u32 && seen.worth == worth;
        if same && seen.slack.minus(&point.slack).none_negative() {
            return true;
        }
        *seen = Seen { dive: self.number, depth: depth as u32, worth, slack: point.slack };
        false
    }

    /// Visits every promising node and keeps each better plan; whether that was completed within
    /// these steps.
    pub(super) fn run(&mut self, budget: &mut Budget, steps: u64) -> bool {
        let mut left = steps.min(budget.left);
        budget.left = budget.left.saturating_sub(left);
        let complete = self.visit(&mut left);
        budget.left = budget.left.saturating_add(left);
        complete
    }

    fn visit(&mut self, left: &mut u64) -> bool {
        let items = self.items;
        let mut point = self.root;
        if !self.promising(0, &point) {
            return true;
        }
        let mut depth = 0usize;
        let mut entering = true;
        loop {
            let below = depth.wrapping_add(1);
            entering = if entering && depth == self.levels {
                self.keep(&point);
                false
            } else {
                let Some(Stage { level, .. }) = self.stages.get_mut(depth) else { return true };
                if entering {
                    (level.cursor, level.point) = (0, point);
                }
                let (at, base, before) = (level.stage as usize, level.base, level.point);
                let mut cursor = level.cursor;
                let Some(stage) = self.stages.get(at) else { return true };
                let (own, count) = (stage.items(items), stage.count);
                let best = own.first().unwrap_or(Item::NONE);
                let allowance = self.allowance();
                let mut chosen = None;
                while cursor < count {
                    // The item of the best plan first, then the others by rising loss.
                    let index = match cursor {
                        0 => base,
                        cursor if cursor <= base => cursor.wrapping_sub(1),
                        cursor => cursor,
                    };
                    cursor = cursor.wrapping_add(1);
                    let Some(item) = own.get(index as usize) else { break };
                    if before.loss.saturating_add(item.loss) > allowance {
                        if cursor > 1 {
                            break; // the ones behind lose even more
                        }
                        continue;
                    }
                    let Some(rest) = left.checked_sub(1) else { return false };
                    *left = rest;
                    let next = before.exchange(best, item);
                    if self.promising(below, &next) && !self.seen_before(below, &next) {
                        (chosen, point) = (Some(index), next);
                        break;
                    }
                }
                if let Some(stage) = self.stages.get_mut(at) {
                    stage.current = chosen.unwrap_or(0);
                }
                if let Some(Stage { level, .. }) = self.stages.get_mut(depth) {
                    level.cursor = cursor;
                }
                chosen.is_some()
            };
            depth = if entering {
                below
            } else {
                let Some(above) = depth.checked_sub(1) else { return true };
                above
            };
        }
    }

    /// Keeps the plan under work as the best and raises the target above it.
    fn keep(&mut self, point: &Point<A>) {
        let worth = self.worth(point);
        debug_assert!(
            self.frame.priced(worth) == self.priced(point),
            "a plan is worth a whole number"
        );
        self.target = worth.wrapping_add(1);
        for stage in self.stages.iter_mut() {
            stage.best = stage.current;
        }
    }
}

/// A place below `count`, from bits that look random.
const fn drawn(mixed: u64, count: usize) -> usize {
    ((mixed as u128).wrapping_mul(count as u128) >> 64) as usize
}
