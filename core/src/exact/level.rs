//! One level of the search, and the bounds of the levels from it on.
//!
//! A node is bounded at several multipliers (value per unit of a row): the best ones, at which its
//! loss says all, and for each row those with this row dearer or cheaper. A node that has run short
//! of a row is excluded by the dearer ones, a node that has left too much of it by the cheaper
//! ones. With *y = step * (what is left of the row)* the first are two steps above the best, the
//! second one step below, so that one product prices both.

use super::congruence::{Remainders, Residues};
use super::dual::Price;
use super::load::Frame;
use super::memory::{Item, Stage};
use super::rows::Rows;

/// An activity with more than one item within the loss allowed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level<const A: usize> {
    /// The activities in the order of the search: a list of its own, made once.
    pub(super) ranked: u16,
    /// The activity, the first of its items, and how many lose no more than is allowed.
    pub(super) stage: u16,
    first: u32,
    count: u16,
    /// The item visited first: that of the plan so far.
    base: u16,
    /// How many items have been visited.
    pub(super) cursor: u16,
    /// The least of its items in each row, and the value of the best one.
    least: [u32; A],
    least_deficit: u32,
    best_value: u32,
    /// What is left before this level, without its least amounts and the value of its best item.
    pub(super) point: Point<A>,
    /// What the levels behind it can do.
    pub(super) rest: Rest<A>,
}

/// What some levels can do for a plan at most.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest<const A: usize> {
    /// What they can gain with a row dearer, and with it cheaper, over what [`Point::room`] says.
    dearer: Rows<A>,
    cheaper: Rows<A>,
    /// What they can add to the value.
    value: i64,
    /// By how much they can change the value, modulo what is common, and at which loss.
    pub(super) residues: Residues,
}

/// What a partial plan leaves, the open activities at their best items.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<const A: usize> {
    /// The room in each row when every open activity takes its least there.
    pub(super) room: Rows<A>,
    /// What the plan loses at the best prices.
    pub(super) loss: i64,
    /// What the plan is worth.
    pub(super) value: i64,
}

impl<const A: usize> Point<A> {
    pub(super) const ZERO: Self = Self { room: Rows::ZERO, loss: 0, value: 0 };

    /// The point with `item` taken.
    #[inline]
    pub(super) fn with(&self, item: &Item<A>) -> Self {
        Self {
            room: self.room.minus(&item.rows()),
            loss: self.loss.wrapping_add(item.loss()),
            value: self.value.wrapping_add(i64::from(item.value)),
        }
    }

    /// The point with `item` not taken any more.
    #[inline]
    pub(super) fn without(&self, item: &Item<A>) -> Self {
        Self {
            room: self.room.plus(&item.rows()),
            loss: self.loss.wrapping_sub(item.loss()),
            value: self.value.wrapping_sub(i64::from(item.value)),
        }
    }
}

impl<const A: usize> Rest<A> {
    /// No level can do anything.
    pub(super) const NONE: Self =
        Self { dearer: Rows::ZERO, cheaper: Rows::ZERO, value: 0, residues: Residues::NONE };

    /// Whether a plan at this point, which lacks so much value and may lose `left`, may be
    /// completed at the dearer and cheaper prices, and at none.
    #[inline]
    pub(super) fn priced(
        &self,
        point: &Point<A>,
        steps: &Rows<A>,
        lacking: i64,
        left: i64,
    ) -> bool {
        if lacking > self.value {
            return false;
        }
        let price = steps.zip(&point.room, i64::wrapping_mul);
        let dearer = self.dearer.plus(&price).plus(&price);
        let cheaper = self.cheaper.minus(&price);
        dearer.zip(&cheaper, |a, b| a.wrapping_add(left) | b.wrapping_add(left)).none_negative()
    }
}

impl<const A: usize> Level<A> {
    pub(super) const EMPTY: Self = Self {
        ranked: 0,
        stage: 0,
        first: 0,
        count: 0,
        base: 0,
        cursor: 0,
        least: [0; A],
        least_deficit: 0,
        best_value: 0,
        point: Point::ZERO,
        rest: Rest::NONE,
    };

    /// The place of the item that is visited at a turn: that of the best plan first, then the
    /// others by rising loss.
    #[inline]
    fn place(&self, turn: u16) -> u16 {
        match turn {
            0 => self.base,
            turn if turn <= self.base => turn.wrapping_sub(1),
            turn => turn,
        }
    }

    /// The place of the item that was visited last.
    pub(super) fn chosen(&self) -> u16 {
        self.place(self.cursor.wrapping_sub(1))
    }

    /// The item that is visited at a turn.
    #[inline]
    pub(super) fn item<'i>(&self, items: &'i [Item<A>], turn: u16) -> Option<&'i Item<A>> {
        let place = self.place(turn);
        if place >= self.count {
            return None;
        }
        items.get(self.first.wrapping_add(place.into()) as usize)
    }

    /// Begins to visit the items, from this point on.
    #[inline]
    pub(super) fn enter(&mut self, point: &Point<A>) {
        let least = Rows { axes: self.least.map(i64::from), quality: self.least_deficit.into() };
        self.cursor = 0;
        self.point = Point {
            room: point.room.plus(&least),
            loss: point.loss,
            value: point.value.wrapping_sub(self.best_value.into()),
        };
    }
}

/// How far the prices of each row are moved to price nodes anew.
pub(super) fn steps<const A: usize>(frame: &Frame<A>, price: &Price<A>) -> Rows<A> {
    // Twice a step more is at most the largest multiplier.
    frame.most_multiplier.zip(&price.multiplier, |most, best| best.min(most.wrapping_sub(best)) / 2)
}

/// Fills the bounds of the levels, from the last one back. Returns how much of each row they can
/// save together, against their best items, and what else they can do.
pub(super) fn prepare<const A: usize>(
    items: &[Item<A>],
    stages: &mut [Stage<A>],
    steps: &Rows<A>,
    none: &Remainders,
    (levels, allowance, fraction): (usize, i64, u32),
) -> (Rows<A>, Rest<A>) {
    let mut saving = Rows::ZERO;
    let mut rest = Rest::NONE;
    let mut remainders = *none;
    let price = |rows: &Rows<A>| steps.zip(rows, i64::wrapping_mul);
    for depth in (0..levels).rev() {
        let at = stages.get(depth).map_or(0, |it| it.level.stage);
        let Some(stage) = stages.get(usize::from(at)) else { break };
        let (first, base) = (stage.first, stage.best);
        let own = stage.items(items);
        let Some(best) = own.first() else { break };
        let (best_value, best) = (best.value, best.rows());
        let mut least = best;
        let mut more = price(&best).zip(&best, |price, _| price.wrapping_mul(-2));
        let mut less = price(&best);
        let (mut count, mut most_value) = (0u16, best_value);
        for item in own.iter().take_while(|item| item.loss() <= allowance) {
            let (rows, loss) = (item.rows(), item.loss());
            let price = price(&rows);
            least = least.zip(&rows, i64::min);
            more =
                more.zip(&price, |most, price| most.max(price.wrapping_mul(-2).wrapping_sub(loss)));
            less = less.zip(&price, |most, price| most.max(price.wrapping_sub(loss)));
            most_value = most_value.max(item.value);
            count = count.wrapping_add(1);
        }
        let floor = price(&least);
        rest.residues = remainders.residues(allowance, fraction);
        let Some(Stage { level, .. }) = stages.get_mut(depth) else { break };
        (level.first, level.count) = (first, count);
        // One that loses too much is not visited.
        level.base = if base < count { base } else { 0 };
        level.least = least.axes.map(|least| least.unsigned_abs() as u32);
        level.least_deficit = least.quality.unsigned_abs() as u32;
        level.best_value = best_value;
        level.rest = rest;
        rest.value = rest.value.wrapping_add(most_value.wrapping_sub(best_value).into());
        rest.dearer = rest.dearer.plus(&more).plus(&floor).plus(&floor);
        rest.cheaper = rest.cheaper.plus(&less).minus(&floor);
        saving = saving.plus(&best).minus(&least);
        if remainders.matter() {
            remainders = remainders.with(own, allowance);
        }
    }
    rest.residues = remainders.residues(allowance, fraction);
    (saving, rest)
}
