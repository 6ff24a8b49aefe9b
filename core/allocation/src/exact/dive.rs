//! Depth-first search for a plan that is worth a target.
//!
//! At the dual prices a plan is worth *bound - sum of reduced costs - price of its slack*. To be
//! worth at least the target, reduced costs and slack together may use up to *allowance = bound -
//! target*; items whose own reduced cost exceeds it cannot be in such a plan (reduced-cost fixing),
//! and activities with one item left need no level.

use super::Budget;
use super::bounds::{prepare, steps};
use super::congruence::{Remainders, grain};
use super::dual::Price;
use super::item::Item;
use super::level::{Point, Rest};
use super::load::Frame;
use super::memory::{Seen, Stage};
use super::rows::{Rows, difference, sum};
use crate::order::{numbered, sort_list};
use core::cmp::Reverse;

/// A depth-first branch and bound: some activities have a level each, the others keep one item.
pub(super) struct Dive<'d, const A: usize> {
    frame: &'d Frame<A>,
    price: &'d Price<A>,
    /// How far the prices are moved to price nodes anew.
    steps: Rows<A>,
    /// The remainders of no level.
    remainders: &'d Remainders,
    items: &'d [Item<A>],
    stages: &'d mut [Stage<A>],
    /// The value looked for; one above the best found once one is found.
    target: i64,
    /// Upper limit of the sum of reduced costs and priced slack.
    allowance: i64,
    levels: usize,
    /// Whether activities without a level keep the item of the best plan, and not their best one.
    around_best: bool,
    /// The point at which every level takes its best item.
    root: Point<A>,
    /// The bounds over all levels.
    rest: Rest<A>,
    /// Bits of a reduced cost that residues leave out.
    grain: u32,
    notes: Notes<'d, A>,
}

/// The nodes that need not be searched twice.
struct Notes<'d, const A: usize> {
    seen: &'d mut [Seen<A>],
    /// How much of `seen` is in use.
    noted: usize,
    /// The last level before which nodes are noted.
    deepest: usize,
    /// Number of this dive, so that what an earlier one has seen is not taken for its own.
    number: u32,
}

/// Levels so near the end that looking a node up costs more than searching it.
const NOT_KEPT: usize = 4;

impl<'d, const A: usize> Dive<'d, A> {
    /// Needs reduced costs, and each activity's items in the order of rising reduced cost.
    pub(super) fn new(
        frame: &'d Frame<A>,
        price: &'d Price<A>,
        remainders: &'d Remainders,
        items: &'d [Item<A>],
        stages: &'d mut [Stage<A>],
        seen: &'d mut [Seen<A>],
    ) -> Self {
        debug_assert!(u16::try_from(stages.len()).is_ok(), "a rank fits its 16 bits");
        for (at, stage) in numbered(stages.iter_mut()) {
            stage.level.ranked = at as u16;
        }
        let before = |stages: &[Stage<A>], a: usize, b: usize| {
            let rank = |at: usize| stages.get(at).map_or(0, |it| it.level.ranked);
            ranked(stages, items, rank(a)) < ranked(stages, items, rank(b))
        };
        let swap = |stages: &mut [Stage<A>], a: usize, b: usize| {
            if let Ok([a, b]) = stages.get_disjoint_mut([a, b]) {
                core::mem::swap(&mut a.level.ranked, &mut b.level.ranked);
            }
        };
        sort_list(stages, before, swap);
        Self {
            frame,
            price,
            steps: steps(frame, price),
            remainders,
            items,
            stages,
            target: 0,
            allowance: 0,
            levels: 0,
            around_best: false,
            root: Point::ZERO,
            rest: Rest::NONE,
            grain: 0,
            notes: Notes { seen, noted: 0, deepest: 0, number: 0 },
        }
    }

    /// Notes nodes from now on, in room for those of a turn of this many steps: clearing more would
    /// cost more than it saves, and easy problems end before any pays.
    pub(super) fn remember(&mut self, steps: u64) {
        let room = usize::try_from(steps).unwrap_or(usize::MAX).min(self.notes.seen.len());
        if room > self.notes.noted {
            self.notes.noted = room;
            self.notes.seen.get_mut(..room).unwrap_or(&mut []).fill(Seen::EMPTY);
        }
    }

    pub(super) fn stages(&self) -> &[Stage<A>] {
        self.stages
    }

    /// The value looked for.
    pub(super) const fn target(&self) -> i64 {
        self.target
    }

    /// Looks for plans worth this from now on.
    pub(super) fn aim(&mut self, target: i64) {
        self.target = target;
        self.allowance = difference(self.price.bound, self.frame.priced(target));
    }

    /// Frees every activity that can change within the allowance.
    pub(super) fn free_all(&mut self) {
        self.levels = 0;
        self.root = Point { room: self.frame.room, ..Point::ZERO };
        self.around_best = false;
        for stage in self.stages.iter() {
            self.root = self.root.with(stage.item(self.items, 0));
        }
        // The costliest change comes first: those that can be made are the last ones.
        for rank in (0..self.stages.len()).rev() {
            let at = self.stages.get(rank).map_or(0, |stage| stage.level.ranked);
            if change(self.stages, self.items, at) > self.allowance {
                break;
            }
            self.levels = self.levels.wrapping_add(1);
        }
        debug_assert!(self.levels <= self.stages.len(), "a level is an activity");
        let first = self.stages.len().saturating_sub(self.levels);
        for depth in 0..self.levels {
            let at =
                self.stages.get(first.wrapping_add(depth)).map_or(0, |stage| stage.level.ranked);
            if let Some(stage) = self.stages.get_mut(depth) {
                stage.level.stage = at;
            }
        }
        self.prepare();
    }

    /// Returns the point of the best plan, and the activity with the largest reduced cost in it.
    pub(super) fn best_point(&self) -> (Point<A>, usize) {
        let mut best = Point { room: self.frame.room, ..Point::ZERO };
        let (mut worst, mut most) = (0, 0);
        for (at, stage) in numbered(self.stages.iter()) {
            let item = stage.item(self.items, stage.best);
            best = best.with(item);
            if item.reduced_cost() > most {
                (worst, most) = (at, item.reduced_cost());
            }
        }
        (best, worst)
    }

    /// Frees an activity and a few more, drawn by `round`; the others keep the best plan, which
    /// leaves `best`.
    pub(super) fn free_some(&mut self, best: Point<A>, first: usize, count: usize, round: u64) {
        self.levels = 0;
        self.around_best = true;
        self.root = best;
        for draw in 0..count as u64 {
            // A multiplicative hash (Knuth, The Art of Computer Programming 3, section 6.4).
            let mixed = (round << 8 | draw).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let at = match (draw, round & 1) {
                (0, 0) => first,
                _ => drawn(mixed, self.stages.len()),
            };
            let Some(stage) = self.stages.get(at) else { continue };
            let (own, best) = (stage.items(self.items), stage.item(self.items, stage.best));
            let at = at as u16;
            let taken = self.stages.iter().take(self.levels).any(|s| s.level.stage == at);
            if !taken && own.get(1).is_some_and(|item| item.reduced_cost() <= self.allowance) {
                self.root = self.root.without(best).with(own.first().unwrap_or(Item::NONE));
                self.free(at);
            }
        }
        self.prepare();
    }

    /// Gives an activity a level, behind those of costlier changes.
    fn free(&mut self, at: u16) {
        debug_assert!(self.levels < self.stages.len(), "each activity has one level at most");
        debug_assert!(usize::from(at) < self.stages.len(), "an activity");
        let mut place = self.levels;
        while let Some(before) = place.checked_sub(1) {
            let other = self.stages.get(before).map_or(0, |stage| stage.level.stage);
            if ranked(self.stages, self.items, other) < ranked(self.stages, self.items, at) {
                break;
            }
            if let Some(stage) = self.stages.get_mut(place) {
                stage.level.stage = other;
            }
            place = before;
        }
        if let Some(stage) = self.stages.get_mut(place) {
            stage.level.stage = at;
            self.levels = self.levels.wrapping_add(1);
        }
    }

    /// Fills the bounds of the levels.
    fn prepare(&mut self) {
        debug_assert!(self.allowance >= 0, "the target is within the bound");
        self.notes.number = self.notes.number.wrapping_add(1);
        let noted = self.notes.noted > 0;
        self.notes.deepest = if noted { self.levels.saturating_sub(NOT_KEPT) } else { 0 };
        self.grain = grain(self.allowance);
        let bounds = (self.levels, self.allowance, self.frame.fraction);
        let (saving, rest) = prepare(self.items, self.stages, &self.steps, self.remainders, bounds);
        self.root.room = self.root.room.plus(&saving);
        self.rest = rest;
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
        let root = self.root;
        if root.reduced_cost > self.allowance || !root.room.none_negative() {
            return true;
        }
        if self.levels == 0 {
            if root.value >= self.target {
                self.keep(root.value);
            }
            return true;
        }
        if !self.promising(&self.rest, &root) {
            return true;
        }
        let Some(stage) = self.stages.first_mut() else { return true };
        stage.level.enter(&root);
        let mut depth = 0usize;
        loop {
            let below = depth.wrapping_add(1);
            let last = below == self.levels;
            debug_assert!(below <= self.levels && self.levels <= self.stages.len(), "a level");
            let Some(Stage { level, .. }) = self.stages.get(depth) else { return true };
            let mut found = None;
            let mut cursor = level.cursor;
            while let Some(item) = level.item(items, cursor) {
                cursor = cursor.wrapping_add(1);
                let point = level.point.with(item);
                if point.reduced_cost > self.allowance {
                    if cursor > 1 {
                        break; // the ones behind lose even more
                    }
                    continue;
                }
                let Some(rest) = left.checked_sub(1) else { return false };
                *left = rest;
                if !point.room.none_negative() {
                    continue;
                }
                let promising = if last {
                    point.value >= self.target
                } else {
                    self.promising(&level.rest, &point)
                        && !(below <= self.notes.deepest && self.notes.seen_before(below, &point))
                };
                if promising {
                    found = Some(point);
                    break;
                }
            }
            if let Some(Stage { level, .. }) = self.stages.get_mut(depth) {
                level.cursor = cursor;
            }
            match found {
                None => {
                    let Some(above) = depth.checked_sub(1) else { return true };
                    depth = above;
                }
                Some(point) if last => self.keep(point.value),
                Some(point) => {
                    let Some(Stage { level, .. }) = self.stages.get_mut(below) else { return true };
                    level.enter(&point);
                    depth = below;
                }
            }
        }
    }

    /// Whether levels that can do `rest` may lead from a point to the target.
    #[inline]
    fn promising(&self, rest: &Rest<A>, point: &Point<A>) -> bool {
        let left = difference(self.allowance, point.reduced_cost);
        let lacking = difference(self.target, point.value);
        rest.priced(point, &self.steps, lacking, left)
            && (!self.remainders.matter()
                || self.remainders.reach(&rest.residues, lacking, left, self.grain))
    }

    /// Keeps the plan under work as the best and raises the target above its value.
    fn keep(&mut self, value: i64) {
        debug_assert!(value >= self.target, "a better plan");
        self.aim(value.wrapping_add(1));
        if !self.around_best {
            for stage in self.stages.iter_mut() {
                stage.best = 0;
            }
        }
        for depth in 0..self.levels {
            let Some(&Stage { level, .. }) = self.stages.get(depth) else { break };
            if let Some(stage) = self.stages.get_mut(usize::from(level.stage)) {
                stage.best = level.chosen();
            }
        }
        debug_assert_eq!(self.best_value(), value, "the plan that is kept is worth this");
    }

    /// Returns the value of the best plan.
    fn best_value(&self) -> i64 {
        let value = |stage: &Stage<A>| i64::from(stage.item(self.items, stage.best).value);
        self.stages.iter().map(value).fold(0, sum)
    }
}

impl<const A: usize> Notes<'_, A> {
    /// Whether a node at least as good was searched at this level before; if not, notes this one.
    ///
    /// The dynamic programme over the limits, as far as memory allows: of two partial plans over
    /// the same activities that are worth the same, the one with less room in every row is not
    /// needed.
    fn seen_before(&mut self, depth: usize, point: &Point<A>) -> bool {
        debug_assert!(0 < self.noted && self.noted <= self.seen.len(), "there is room for nodes");
        let node = Seen::new(self.number, depth, point.value, &point.room);
        let Some(seen) = self.seen.get_mut(drawn(node.mixed(), self.noted)) else { return false };
        if seen.covers(&node) {
            return true;
        }
        *seen = node;
        false
    }
}

/// Returns the least cost of a change of an activity: the reduced cost of its second item.
fn change<const A: usize>(stages: &[Stage<A>], items: &[Item<A>], at: u16) -> i64 {
    debug_assert!((at as usize) < stages.len(), "an activity");
    let own = stages.get(usize::from(at)).map_or(&[][..], |stage| stage.items(items));
    own.get(1).map_or(i64::MAX, Item::reduced_cost)
}

/// Returns the sort key of an activity: the costliest to change is searched first, since a change
/// there leaves little for the others.
fn ranked<const A: usize>(stages: &[Stage<A>], items: &[Item<A>], at: u16) -> (Reverse<i64>, u16) {
    (Reverse(change(stages, items, at)), at)
}

/// A place below `count`, from bits that look random.
const fn drawn(mixed: u64, count: usize) -> usize {
    debug_assert!(count > 0, "there is a place to draw");
    ((mixed as u128).wrapping_mul(count as u128) >> 64) as usize
}
