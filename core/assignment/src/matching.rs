//! Whether each row can have a column at all, whatever it costs.
//!
//! A row takes a free column, or along an alternating path one whose row can take another (P. Hall,
//! 1935). Where edges are missing this is asked before costs are looked at: a price war about
//! columns that do not suffice takes several times as long as to count them.

use super::amount::Amount;
use super::assignment::{AssignmentError, Work};
use super::cost::Cost;
use super::memory::{Memory, put};
use super::scan::present;

impl<N: Amount> Work<'_, N> {
    /// Refuses rows that are in conflict, where edges are missing.
    pub(super) fn can_all_have_one(&mut self) -> Result<(), AssignmentError> {
        if !self.costs.lacks_any() {
            return Ok(());
        }
        for row in 0..self.costs.rows() {
            let size = self.size(row);
            put(self.memory.conflict, row, size);
        }
        self.list_columns();
        let mut taken = 0_usize;
        // A row with few columns chooses first, and seldom has to ask another row for one.
        for size in 0..=bits(self.costs.columns() as u32) {
            for row in 0..self.costs.rows() {
                if self.memory.conflict.get(row) == Some(&size)
                    && let Some((column, at)) = self.next(row, taken)
                {
                    self.meet(at, taken);
                    self.give(row as u32, column);
                    taken = taken.wrapping_add(1);
                }
            }
        }
        for row in 0..self.costs.rows() {
            if self.memory.column(row).is_none() {
                self.match_row(row as u32)?;
            }
        }
        self.memory.conflict.fill(0);
        self.memory.column_of.fill(0);
        self.memory.row_of.fill(0);
        Ok(())
    }

    /// A shortest path of exchanges from a row to a free column.
    fn match_row(&mut self, from: u32) -> Result<(), AssignmentError> {
        self.list_columns();
        let (mut row, mut met, mut looked) = (from, 0_usize, 0_usize);
        loop {
            // Columns in between were examined, and changed places with those that are met.
            let mut behind = met;
            while let Some((column, at)) = self.next(row as usize, behind) {
                put(self.memory.before, column, row);
                if self.memory.row(column).is_none() {
                    self.exchange(from, column, met);
                    return Ok(());
                }
                self.meet(at, met);
                met = met.wrapping_add(1);
                behind = at.wrapping_add(1);
            }
            let next = self.memory.done.get(looked).filter(|_| looked < met);
            let Some(next) = next.and_then(|it| self.memory.row(*it as usize)) else {
                return Err(self.conflict(from as usize, met));
            };
            (row, looked) = (next as u32, looked.wrapping_add(1));
        }
    }

    /// How many bits it takes to say how many columns a row can have.
    fn size(&self, row: usize) -> u32 {
        bits(present(self.costs.entries(row), self.costs.least()))
    }

    /// Lists all columns: first those that nobody has.
    fn list_columns(&mut self) {
        let Memory { row_of, done, .. } = &mut self.memory;
        let mut list = done.iter_mut();
        for is_taken in [false, true] {
            let mut number = 0_u32;
            for row in row_of.iter() {
                if (*row != 0) == is_taken
                    && let Some(it) = list.next()
                {
                    *it = number;
                }
                number = number.wrapping_add(1);
            }
        }
    }

    /// The first column listed from here on that a row can have, and where it is listed.
    fn next(&self, row: usize, from: usize) -> Option<(usize, usize)> {
        let (entries, least) = (self.costs.entries(row), self.costs.least());
        let mut at = from;
        for column in self.memory.done.get(from..)? {
            let entry = entries.get(*column as usize).copied().flatten();
            if Cost::upside_down(entry) >= least {
                return Some((*column as usize, at));
            }
            at = at.wrapping_add(1);
        }
        None
    }

    /// The column listed here is the next that is met.
    fn meet(&mut self, at: usize, met: usize) {
        debug_assert!(met <= at && at < self.memory.done.len(), "a column is met once");
        if at < self.memory.done.len() && met < self.memory.done.len() {
            self.memory.done.swap(at, met);
        }
    }
}

/// How many bits a number has.
const fn bits(number: u32) -> u32 {
    u32::BITS.saturating_sub(number.leading_zeros())
}
