//! Exchanges among columns that are equally near, at the prices as they are.
//!
//! Where costs are few and rows are many, most rows can have one of several columns that are all as
//! near as the nearest (the equality subgraph of H. W. Kuhn, *The Hungarian method for the
//! assignment problem*, Naval Research Logistics Quarterly 2, 1955). A path among these needs no
//! lengths and changes no price, so that to look at a row takes half of the time that it takes on a
//! shortest path.

use super::amount::Amount;
use super::assignment::{AssignmentError, Work};
use super::memory::{Memory, number, put};
use super::scan::Row;

/// Limit of noting beforehand: one of so many rows may be left without a column.
const FEW: usize = 16;

impl<N: Amount> Work<'_, N> {
    /// Notes for each row a column that nobody has and that is as near to it as its own, where few
    /// are left: a path ends where it meets such a row, long before it looks at that. It stays so
    /// until somebody has that column: no path that changes prices gets beyond such a row.
    pub(super) fn look_ahead(&mut self) {
        let Self { costs, memory: Memory { row_of, column_of, conflict, prices, done, .. } } = self;
        let few = costs.rows() / FEW;
        let (mut free, mut column) = (0_usize, 0_u32);
        for row in row_of.iter() {
            if *row == 0 {
                if free == few {
                    return;
                }
                put(done, free, column);
                free = free.wrapping_add(1);
            }
            column = column.wrapping_add(1);
        }
        for (row, note) in (0..costs.rows()).zip(conflict.iter_mut()) {
            let Some(own) = number(column_of, row) else { continue };
            let row = Row::new(costs, row, prices);
            let near = row.near_of(own).plus(N::HALF);
            for column in done.iter().take(free) {
                if row.near_of(*column as usize) == near {
                    // The last bit says who is in conflict.
                    *note = (*note & 1) | column.wrapping_add(1).wrapping_shl(1);
                }
            }
        }
    }

    /// Whether a row has joined along columns that are each as near as the nearest to the row that
    /// takes it.
    pub(super) fn join(&mut self, from: u32) -> Result<bool, AssignmentError> {
        let away = self.row(from as usize).two_nearest().away;
        if away == N::FAR {
            return Ok(false);
        }
        match self.path(from, N::away(away.whole())) {
            (Some(end), met) => {
                self.reprice(end, |it| it.minus(N::HALF))?;
                self.exchange(from, end, met);
                Ok(true)
            }
            (None, met) => self.join_beyond(from, away.whole(), met),
        }
    }

    /// The column that nobody has at the end of such a path, if there is one, and how many columns
    /// were met. The nearest column of the row is so near. Every row is looked at once.
    fn path(&mut self, from: u32, mut near: N) -> (Option<usize>, usize) {
        let Self { costs, memory } = self;
        let Memory { row_of, conflict, before, done, prices, distances, .. } = memory;
        // Prices again, in which columns that are met become too dear for every row.
        distances.iter_mut().zip(prices.iter()).for_each(|(to, it)| *to = *it);
        let (mut row, mut met, mut looked) = (from, 0_usize, 0_usize);
        loop {
            let mut end = None;
            let free = Row::new(costs, row as usize, prices).equals(near, distances, |column| {
                put(before, column, row);
                put(done, met, column as u32);
                met = met.wrapping_add(1);
                let owner = number(row_of, column);
                let note = owner.and_then(|it| conflict.get(it)).map_or(0, |it| it.wrapping_shr(1));
                let noted = note.checked_sub(1).map(|it| it as usize);
                end = noted.filter(|it| number(row_of, *it).is_none());
                if let (Some(end), Some(owner)) = (end, owner) {
                    put(before, end, owner as u32);
                }
                end.is_some()
            });
            if let Some(free) = free {
                put(before, free, row);
            }
            if end.is_some() || free.is_some() {
                return (end.or(free), met);
            }
            let next = done.get(looked).filter(|_| looked < met).map(|it| *it as usize);
            let next = next.and_then(|column| Some((column, number(row_of, column)?)));
            let Some((column, owner)) = next else { return (None, met) };
            // A row has its nearest column, which counts a half more as it is taken.
            near = Row::new(costs, owner, prices).near_of(column).plus(N::HALF);
            (row, looked) = (owner as u32, looked.wrapping_add(1));
        }
    }

    /// Completes the columns that are met, all so far away, by the rest of a shortest path if few
    /// others are left. Returns whether few are left.
    fn join_beyond(&mut self, from: u32, away: N, met: usize) -> Result<bool, AssignmentError> {
        let columns = self.costs.columns();
        if columns.saturating_sub(met) > columns / 2 {
            return Ok(false);
        }
        self.memory.distances.fill(N::FAR);
        debug_assert!(met <= columns, "a column is met once");
        for at in 0..met {
            let column = self.memory.done.get(at).copied().unwrap_or(0);
            self.settle(column as usize, at, away.plus(N::HALF));
        }
        let Memory { done, distances, .. } = &mut self.memory;
        let (mut left, mut column) = (met, 0_u32);
        for it in distances.iter() {
            if *it != N::DONE {
                put(done, left, column);
                left = left.wrapping_add(1);
            }
            column = column.wrapping_add(1);
        }
        self.reach_left(from as usize, N::ZERO, met);
        for at in 0..met {
            let column = self.memory.done.get(at).map_or(0, |it| *it as usize);
            if let Some(row) = self.memory.row(column) {
                let base = self.base(row, column, away.plus(N::HALF))?;
                self.reach_left(row, base, met);
            }
        }
        let Memory { done, distances, .. } = &self.memory;
        let length = |it: &u32| (distances.get(*it as usize).copied(), *it as usize);
        let lengths = done.iter().skip(met).map(length);
        let (length, column) = lengths.min().unwrap_or((None, 0));
        self.grow_on(from, met, (length.unwrap_or(N::FAR), column))?;
        Ok(true)
    }

    /// Shortens the paths to the columns that are left by a row to which it costs so much to come.
    fn reach_left(&mut self, row: usize, base: N, met: usize) {
        let Self { costs, memory: Memory { prices, distances, before, done, .. } } = self;
        let prices = Row::new(costs, row, prices);
        for column in done.iter().skip(met).map(|it| *it as usize) {
            let value = prices.away_of(column).map_or(N::FAR, |it| it.plus(base));
            if distances.get(column).is_some_and(|it| value < *it) {
                put(distances, column, value);
                put(before, column, row as u32);
            }
        }
    }
}
