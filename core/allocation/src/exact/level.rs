//! One level of the search, and what is known of the levels behind it.

use super::item::Item;
use super::rows::{Rows, difference, product, sum};

/// The most remainders kept.
pub(super) const REMAINDERS: usize = 16;

/// An activity with more than one item within the reduced cost allowed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level<const A: usize> {
    /// The activities in the order of the search: a list of its own, made once.
    pub(super) ranked: u16,
    /// The activity, the first of its items, and how many lose no more than is allowed.
    pub(super) stage: u16,
    pub(super) first: u32,
    pub(super) count: u16,
    /// The item visited first: that of the plan so far.
    pub(super) base: u16,
    /// How many items have been visited.
    pub(super) cursor: u16,
    /// The least of its items in each row, and the value of the best one.
    pub(super) least: [u32; A],
    pub(super) least_deficit: u32,
    pub(super) best_value: u32,
    /// The point before this level, without its least amounts and the value of its best item.
    pub(super) point: Point<A>,
    /// The bounds over the levels behind this one.
    pub(super) rest: Rest<A>,
}

/// Upper bounds of the contribution of some levels to a plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest<const A: usize> {
    /// Largest gain of the levels with a row dearer, and with it cheaper, over [`Point::room`].
    pub(super) dearer: Rows<A>,
    pub(super) cheaper: Rows<A>,
    /// Largest sum that the levels add to the value.
    pub(super) value: i64,
    /// By how much they can change the value, modulo what is common, and at which reduced cost.
    pub(super) residues: Residues,
}

/// Totals of a partial plan, with the open activities at their best items.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<const A: usize> {
    /// The room in each row when every open activity takes its least there.
    pub(super) room: Rows<A>,
    /// Sum of the reduced costs at the best prices.
    pub(super) reduced_cost: i64,
    /// Value of the plan.
    pub(super) value: i64,
}

/// The least reduced cost at which some activities gain each remainder or more, in few bytes:
/// rounded down, so that no plan is excluded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residues {
    pub(super) least: [u16; REMAINDERS],
}

impl Residues {
    /// Every value can be reached.
    pub(super) const NONE: Self = Self { least: [0; REMAINDERS] };
}

impl<const A: usize> Point<A> {
    pub(super) const ZERO: Self = Self { room: Rows::ZERO, reduced_cost: 0, value: 0 };

    /// The point with `item` taken.
    #[inline]
    pub(super) fn with(&self, item: &Item<A>) -> Self {
        Self {
            room: self.room.minus(&item.rows()),
            reduced_cost: sum(self.reduced_cost, item.reduced_cost()),
            value: sum(self.value, i64::from(item.value)),
        }
    }

    /// The point with `item` not taken any more.
    #[inline]
    pub(super) fn without(&self, item: &Item<A>) -> Self {
        Self {
            room: self.room.plus(&item.rows()),
            reduced_cost: difference(self.reduced_cost, item.reduced_cost()),
            value: difference(self.value, i64::from(item.value)),
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
        let price = steps.zip(&point.room, product);
        let dearer = self.dearer.plus(&price).plus(&price);
        let cheaper = self.cheaper.minus(&price);
        dearer.zip(&cheaper, |a, b| sum(a, left) | sum(b, left)).none_negative()
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
    /// others by rising reduced cost.
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
        debug_assert!(0 < self.cursor && self.cursor <= self.count, "an item has been visited");
        self.place(self.cursor.wrapping_sub(1))
    }

    /// The item that is visited at a turn.
    #[inline]
    pub(super) fn item<'i>(&self, items: &'i [Item<A>], turn: u16) -> Option<&'i Item<A>> {
        let place = self.place(turn);
        if place >= self.count {
            return None;
        }
        debug_assert!(self.first as usize + usize::from(self.count) <= items.len(), "its items");
        items.get(self.first.wrapping_add(place.into()) as usize)
    }

    /// Begins to visit the items, from this point on.
    #[inline]
    pub(super) fn enter(&mut self, point: &Point<A>) {
        let least = Rows { axes: self.least.map(i64::from), quality: self.least_deficit.into() };
        self.cursor = 0;
        self.point = Point {
            room: point.room.plus(&least),
            reduced_cost: point.reduced_cost,
            value: difference(point.value, self.best_value.into()),
        };
    }
}
