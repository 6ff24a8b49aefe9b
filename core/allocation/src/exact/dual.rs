//! The Lagrangian dual: prices for the limits that make the bound least.
//!
//! For multipliers *u >= 0* (value per unit of a row) every feasible plan is worth at most *L(u) =
//! sum over activities of max(value - u * cost) + u * room*, a convex function of *u*. Each row is
//! minimised by a search between two tangents (the secant step of Kelley 1960 in one dimension),
//! the rows nested in one another. Any *u* gives a valid bound, so rounding costs tightness only,
//! never truth.

use super::load::Frame;
use super::rows::{Rows, difference, sum};
use super::{Budget, Item, Stage};

/// A point of the dual function.
#[derive(Clone, Copy, Debug)]
pub(super) struct Price<const A: usize> {
    /// Value per unit of each row, with [`Frame::fraction`] fraction bits.
    pub(super) multiplier: Rows<A>,
    /// The bound there, with the same fraction bits.
    pub(super) bound: i64,
    /// A subgradient: room less what the best items there take.
    slope: Rows<A>,
}

/// Evaluates and minimises the dual of loaded items.
pub(super) struct Dual<'d, const A: usize> {
    pub(super) frame: &'d Frame<A>,
    pub(super) items: &'d [Item<A>],
    pub(super) stages: &'d [Stage<A>],
    pub(super) budget: &'d mut Budget,
}

/// Evaluations of one row between its tangents before the search settles for what it has.
const SECANTS: u32 = 32;

impl<const A: usize> Dual<'_, A> {
    /// The multipliers of the least bound found; `None` when the budget does not allow one
    /// evaluation.
    pub(super) fn minimise(&mut self) -> Option<Price<A>> {
        self.descend(Rows::<A>::COUNT, Rows::ZERO)
    }

    /// The bound at these multipliers.
    fn price(&mut self, multiplier: Rows<A>) -> Option<Price<A>> {
        self.budget.take(self.stages.len() as u64)?;
        let above = self.frame.most_multiplier.minus(&multiplier);
        debug_assert!(above.none_negative() && multiplier.none_negative(), "priced sums fit");
        let mut bound = multiplier.dot(&self.frame.room);
        let mut slope = self.frame.room;
        for stage in self.stages {
            let mut best = i64::MIN;
            let mut taken = None;
            for item in stage.items(self.items) {
                let reduced = item.reduced(&multiplier, self.frame.fraction);
                if reduced > best {
                    best = reduced;
                    taken = Some(item);
                }
            }
            debug_assert!(taken.is_some(), "each activity has an item");
            if let Some(item) = taken {
                bound = sum(bound, best);
                slope = slope.minus(&item.rows());
            }
        }
        Some(Price { multiplier, bound, slope })
    }

    /// The least bound over the multipliers of the first `rows` rows, the others as they stand in
    /// `from`.
    fn descend(&mut self, rows: usize, from: Rows<A>) -> Option<Price<A>> {
        let Some(row) = rows.checked_sub(1) else { return self.price(from) };
        let most = self.frame.most_multiplier.get(row);
        if most == 0 {
            return self.descend(row, from);
        }
        let start = self.descend(row, from)?;
        let rising = start.slope.get(row) < 0; // the bound falls as this multiplier grows
        if start.slope.get(row) == 0 || (!rising && start.multiplier.get(row) == 0) {
            return Some(start);
        }
        // Gallop to a second tangent of the other sign.
        let mut near = start;
        let mut stride = (start.multiplier.get(row) / 16).max(most >> 16).max(1);
        let far = loop {
            let place = near.multiplier.get(row);
            let next = if rising {
                place.saturating_add(stride).min(most)
            } else {
                place.saturating_sub(stride).max(0)
            };
            if next == place {
                return Some(near); // the end of the range, still falling
            }
            let Some(price) = self.at(row, next, &near) else { return Some(near) };
            if (price.slope.get(row) < 0) != rising {
                break price;
            }
            near = price;
            stride = stride.saturating_mul(4);
        };
        let (mut low, mut high) = if rising { (near, far) } else { (far, near) };
        for _ in 0..SECANTS {
            let (left, right) = (low.multiplier.get(row), high.multiplier.get(row));
            let (down, up) = (low.slope.get(row), high.slope.get(row));
            debug_assert!(left <= right && down < 0 && up >= 0, "the least bound is in between");
            let width = difference(right, left);
            if up == 0 || width <= 1 {
                break;
            }
            // The intersection of the tangents, and the least bound possible there.
            let gap = i128::from(high.bound).wrapping_sub(i128::from(low.bound));
            let fall = i128::from(up).wrapping_sub(i128::from(down));
            debug_assert!(fall > 0, "the tangents meet");
            let Some(step) =
                i128::from(up).wrapping_mul(i128::from(width)).wrapping_sub(gap).checked_div(fall)
            else {
                break;
            };
            let floor = i128::from(low.bound).wrapping_add(i128::from(down).wrapping_mul(step));
            let best = i128::from(low.bound.min(high.bound));
            if best.wrapping_sub(floor) <= i128::from(self.frame.priced(1) >> 7) {
                break;
            }
            let inner = i64::try_from(step).unwrap_or(1).max(1).min(difference(width, 1));
            let middle = sum(left, inner);
            debug_assert!(left < middle && middle < right, "the range becomes smaller");
            let nearest = if inner < difference(width, inner) { low } else { high };
            let Some(price) = self.at(row, middle, &nearest) else { break };
            if price.slope.get(row) < 0 {
                low = price;
            } else {
                high = price;
            }
        }
        Some(meet(&low, &high, row))
    }

    /// The least bound over the rows before `row`, with `row`'s multiplier set and the search begun
    /// near `near`.
    fn at(&mut self, row: usize, multiplier: i64, near: &Price<A>) -> Option<Price<A>> {
        let mut from = near.multiplier;
        from.set(row, multiplier);
        self.descend(row, from)
    }
}

/// The better of two points, with the combination of their slopes that is level in `row`: the
/// subgradient at the minimum between them, which the rows further out need.
fn meet<const A: usize>(low: &Price<A>, high: &Price<A>, row: usize) -> Price<A> {
    let down = i128::from(low.slope.get(row)).wrapping_neg();
    let up = i128::from(high.slope.get(row));
    let better = if low.bound < high.bound { low } else { high };
    debug_assert!(down >= 0 && up >= 0, "the bound falls to the one and rises from the other");
    let both = down.wrapping_add(up);
    if both <= 0 {
        return *better;
    }
    let mix = |a: i64, b: i64| {
        let sum = i128::from(a).wrapping_mul(up).wrapping_add(i128::from(b).wrapping_mul(down));
        sum.checked_div(both).unwrap_or(0) as i64
    };
    let mut slope = low.slope.zip(&high.slope, mix);
    slope.set(row, 0);
    Price { multiplier: better.multiplier, bound: better.bound, slope }
}
