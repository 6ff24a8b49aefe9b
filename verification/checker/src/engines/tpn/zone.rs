//! Sets of values of clocks: difference bound matrices (Dill 1989).
//!
//! Row and column 0 stand for zero, the others for the clocks of the enabled transitions in their
//! order; entry (i, j) is the upper bound of xᵢ - xⱼ, as tight as it can be.

use super::bound::Bound;
use super::markings::ANEW;

/// A set of values of clocks that is not empty.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Zone {
    size: usize,
    entries: Vec<Bound>,
}

impl Zone {
    /// So many clocks, all of which have just started.
    pub(super) fn zero(clocks: usize) -> Self {
        let size = clocks + 1;
        Self { size, entries: vec![Bound::ZERO; size * size] }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.entries)
    }

    #[inline]
    fn at(&self, row: usize, column: usize) -> Bound {
        self.entries[row * self.size + column]
    }

    #[inline]
    fn set(&mut self, row: usize, column: usize, bound: Bound) {
        self.entries[row * self.size + column] = bound;
    }

    /// Whether every value of another set of the same clocks is in this one.
    pub(super) fn contains(&self, other: &Self) -> bool {
        debug_assert_eq!(self.size, other.size, "sets of the same clocks");
        self.entries.iter().zip(&other.entries).all(|(it, other)| other <= it)
    }

    /// The values whose difference has this bound as well; `None` when there is none.
    pub(super) fn with(mut self, row: usize, column: usize, bound: Bound) -> Option<Self> {
        debug_assert!(row < self.size && column < self.size);
        if bound >= self.at(row, column) {
            return Some(self);
        }
        if self.at(column, row).plus(bound) < Bound::ZERO {
            return None;
        }
        self.set(row, column, bound);
        for from in 0..self.size {
            let first = self.at(from, row).plus(bound);
            if first == Bound::INFINITE {
                continue;
            }
            for to in 0..self.size {
                let path = first.plus(self.at(column, to));
                if path < self.at(from, to) {
                    self.set(from, to, path);
                }
            }
        }
        Some(self)
    }

    /// The values that are in both; `None` when there is none.
    pub(super) fn and(&self, other: &Self) -> Option<Self> {
        let mut both = self.clone();
        for row in 0..self.size {
            for column in 0..self.size {
                both = both.with(row, column, other.at(row, column))?;
            }
        }
        Some(both)
    }

    /// The values that are in this set and not in the other one, as disjoint sets.
    pub(super) fn without(&self, other: &Self) -> Vec<Self> {
        let (mut parts, mut rest) = (Vec::new(), self.clone());
        for row in 0..self.size {
            for column in 0..self.size {
                let bound = other.at(row, column);
                if bound < rest.at(row, column) {
                    parts.extend(rest.clone().with(column, row, bound.beyond()));
                    match rest.with(row, column, bound) {
                        Some(within) => rest = within,
                        None => return parts,
                    }
                }
            }
        }
        parts
    }

    /// The values of a clock (from 1) up to the end of an interval.
    pub(super) fn at_most(self, clock: usize, upper: Bound) -> Option<Self> {
        self.with(clock, 0, upper)
    }

    /// The values of a clock from the beginning of an interval on, as the bound of the negated
    /// clock.
    pub(super) fn at_least(self, clock: usize, lower: Bound) -> Option<Self> {
        self.with(0, clock, lower)
    }

    /// The same after any time.
    pub(super) fn later(mut self) -> Self {
        (1..self.size).for_each(|clock| self.set(clock, 0, Bound::INFINITE));
        self
    }

    /// The same any time before, as long as no clock is negative.
    pub(super) fn earlier(mut self) -> Self {
        for clock in 1..self.size {
            let differences = (1..self.size).map(|other| self.at(other, clock));
            let bound = differences.fold(Bound::ZERO, Bound::min);
            self.set(0, clock, bound);
        }
        self
    }

    /// A clock shows any time from a bound on: nothing more depends on how much it shows.
    pub(super) fn beyond(mut self, clock: usize, lower: Bound) -> Option<Self> {
        for other in (0..self.size).filter(|it| *it != clock) {
            self.set(clock, other, Bound::INFINITE);
            let bound = self.at(other, 0);
            self.set(other, clock, bound);
        }
        self.set(0, clock, Bound::ZERO);
        self.at_least(clock, lower)
    }

    /// After a firing: for each clock the position (from 0) that it had before, or [`ANEW`].
    pub(super) fn fired(&self, kept: &[u32]) -> Self {
        let before = |at: usize| match at.checked_sub(1).map(|it| kept[it]) {
            None | Some(ANEW) => 0,
            Some(position) => position as usize + 1,
        };
        let size = kept.len() + 1;
        debug_assert!((1..size).all(|it| before(it) < self.size), "a clock that was there is kept");
        let entry = |at: usize| self.at(before(at / size), before(at % size));
        Self { size, entries: (0..size * size).map(entry).collect() }
    }

    /// Before a firing in a net with so many enabled transitions: the values that lead into this
    /// set when clocks that start anew are set to zero; `None` when there are none.
    pub(super) fn before(&self, kept: &[u32], clocks: usize) -> Option<Self> {
        let mut inside = self.clone();
        for (at, _) in (1..).zip(kept).filter(|it| *it.1 == ANEW) {
            inside = inside.at_most(at, Bound::ZERO)?;
        }
        let size = clocks + 1;
        // Clocks that ended show anything.
        let mut after = vec![None; size];
        after[0] = Some(0);
        for (at, &position) in (1..).zip(kept).filter(|it| *it.1 != ANEW) {
            debug_assert!(after[position as usize + 1].is_none(), "a clock is kept once");
            after[position as usize + 1] = Some(at);
        }
        let mut zone = Self { size, entries: vec![Bound::INFINITE; size * size] };
        for row in 0..size {
            for column in 0..size {
                let bound = match (after[row], after[column]) {
                    _ if row == column => Bound::ZERO,
                    (Some(row), Some(column)) => inside.at(row, column),
                    // A clock that shows anything is not negative.
                    (Some(row), None) => inside.at(row, 0),
                    (None, _) => Bound::INFINITE,
                };
                zone.set(row, column, bound);
            }
        }
        Some(zone)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tpn::Interval;

    fn bounds(lower: u64, upper: u64) -> (Bound, Bound) {
        let interval = Interval::closed(lower, upper);
        (Bound::lower(interval), Bound::upper(interval))
    }

    #[test]
    fn a_zone_is_the_union_of_a_part_and_the_rest() {
        let (one, two) = (bounds(1, 3), bounds(2, 5));
        let whole = Zone::zero(2).later().at_most(1, bounds(0, 9).1).unwrap();
        let part = whole.clone().at_least(1, two.0).unwrap().at_most(2, one.1).unwrap();
        let rest = whole.without(&part);
        assert_eq!(rest.len(), 2);
        assert!(rest.iter().all(|it| whole.contains(it) && it.and(&part).is_none()));
        assert!(whole.without(&whole).is_empty());
        assert_eq!(whole.and(&part), Some(part));
    }

    #[test]
    fn a_clock_goes_back_and_on() {
        let start = Zone::zero(1);
        let later = start.clone().later().at_most(1, bounds(0, 4).1).unwrap();
        assert!(later.contains(&start));
        let end = later.at_least(1, bounds(4, 4).0).unwrap();
        assert!(!end.contains(&start) && end.earlier().contains(&start));
    }
}
