//! Assignment: each row gets a column of its own, at the least sum of costs.
//!
//! R. Jonker and A. Volgenant, *A shortest augmenting path algorithm for dense and sparse linear
//! assignment problems*, Computing 38, 1987: reductions find a first part of the assignment, and
//! each row that is left joins along a shortest path of exchanges. Their reduction of rows may go
//! on for as long as costs are large where edges are missing, so it may take a number of steps, and
//! the paths do the rest; their reduction of columns comes first only where each column is needed.

use super::amount::Amount;
use super::cost::{Cost, Costs};
use super::memory::{Memory, put};
use super::proof::conflict;
use super::scan::{Nearest, Reach, Row, cheapest, reach};
use cotama_units::memory::{MemoryError, enough};

/// How often rows push each other out without gain; paths of such exchanges are looked for later.
const LEVEL: usize = 4;
/// For fewer rows to count columns, and to look for paths among equally near ones, costs more than
/// it saves. Chosen, not tuned.
pub(super) const MANY: usize = 64;

/// Why there is no assignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssignmentError {
    /// Some rows have, all together, fewer columns than they are (P. Hall, *On representatives of
    /// subsets*, 1935); [`Memory::in_conflict`] tells which, [`conflict`](super::conflict)
    /// counts again.
    Infeasible {
        /// How many rows are in conflict.
        rows: usize,
        /// How many columns these rows could have.
        columns: usize,
    },
    /// Costs or prices pass the width of the [`Amount`]: take [`i64`].
    TooLarge,
    /// There is too little memory.
    Memory(MemoryError),
}

impl core::fmt::Display for AssignmentError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Infeasible { rows, columns } => {
                write!(f, "{rows} rows could have {columns} columns only")
            }
            Self::TooLarge => f.write_str("costs or prices are too large for 32 bits"),
            Self::Memory(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for AssignmentError {}

impl From<MemoryError> for AssignmentError {
    fn from(error: MemoryError) -> Self {
        Self::Memory(error)
    }
}

/// Assigns each row a column at the least total, and returns that. `memory` holds the assignment
/// and the prices that prove it; [`is_least`](super::is_least) is the proof. Columns may be left
/// over. The same table gives the same assignment.
///
/// ```
/// use cotama_core::team::{Cost, Costs, Fixed, AssignmentError, assign, is_least};
/// let entries = [Cost::new(9), None, Cost::new(2), Cost::new(8), Cost::new(7), Cost::new(2)];
/// let table = Costs::new(&entries, 3).unwrap();
/// let mut fixed = Fixed::<i32, 2, 3>::new();
/// let mut memory = fixed.memory();
/// assert_eq!(assign(&table, &mut memory), Ok(9));
/// assert_eq!(is_least(&table, |row| memory.column(row), |column| memory.price(column)), Ok(9));
///
/// let cheap = table.at_most(Cost::new(5).unwrap()); // both need the last column
/// let conflict = AssignmentError::Infeasible { rows: 2, columns: 1 };
/// assert_eq!(assign(&cheap, &mut memory), Err(conflict));
/// ```
///
/// # Errors
/// [`AssignmentError`]: some rows are in conflict, the amounts are too narrow, or memory lacks.
#[inline]
pub fn assign<N: Amount>(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, N>,
) -> Result<u64, AssignmentError> {
    // A program has only the code it needs if the compiler knows the memory, as of `Fixed`.
    if memory.size().0 < MANY {
        assign_sized::<N, false>(costs, memory)
    } else {
        assign_sized::<N, true>(costs, memory)
    }
}

#[inline(never)]
fn assign_sized<N: Amount, const LARGE: bool>(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, N>,
) -> Result<u64, AssignmentError> {
    let mut work = Work::start(costs, memory)?;
    work.memory.conflict.fill(0);
    if costs.rows() > costs.columns() {
        return Err(work.all_in_conflict());
    }
    if LARGE && costs.rows() >= MANY {
        work.can_all_have_one()?;
    }
    work.assign::<LARGE>()
}

/// An assignment under work.
pub(super) struct Work<'w, N> {
    pub(super) costs: &'w Costs<'w>,
    pub(super) memory: Memory<'w, N>,
}

impl<'w, N: Amount> Work<'w, N> {
    /// Empty, with memory for the table.
    pub(super) fn start(
        costs: &'w Costs<'w>,
        memory: &'w mut Memory<'_, N>,
    ) -> Result<Self, AssignmentError> {
        let (rows, columns) = memory.size();
        enough("assignment", costs.rows(), rows)?;
        enough("assignment", costs.columns(), columns)?;
        let lacks = MemoryError { what: "assignment", needed: usize::MAX, given: columns };
        let memory = memory.cleared(costs.rows(), costs.columns()).ok_or(lacks)?;
        if N::room_for(costs.most()) {
            Ok(Self { costs, memory })
        } else {
            Err(AssignmentError::TooLarge)
        }
    }

    /// Assigns each row a column at the least total. Tables of [`MANY`] rows are `LARGE`.
    pub(super) fn assign<const LARGE: bool>(&mut self) -> Result<u64, AssignmentError> {
        let costs = self.costs;
        if costs.rows() == costs.columns() {
            self.reduce_columns()?;
        }
        self.reduce_rows()?;
        let is_large = LARGE && costs.rows() >= MANY;
        if is_large {
            self.look_ahead();
        }
        for row in 0..costs.rows() {
            if self.memory.column(row).is_none() && !(is_large && self.join(row as u32)?) {
                self.grow(row as u32)?;
            }
        }
        self.lower_prices();
        Ok(self.total())
    }

    /// The sum of the costs.
    fn total(&self) -> u64 {
        let cost = |row| self.memory.column(row).and_then(|it| self.costs.cost(row, it));
        let mut rows = 0..self.costs.rows();
        debug_assert!(
            rows.all(|row| cost(row).is_some()),
            "each row has a column that it can have"
        );
        let costs = (0..self.costs.rows()).map(|row| u64::from(cost(row).map_or(0, Cost::get)));
        costs.fold(0, u64::saturating_add)
    }

    /// A row gets a column that nobody has any more.
    pub(super) fn give(&mut self, row: u32, column: usize) {
        put(self.memory.row_of, column, row.wrapping_add(1));
        put(self.memory.column_of, row as usize, (column as u32).wrapping_add(1));
    }

    /// Changes the price of a column.
    pub(super) fn reprice(
        &mut self,
        column: usize,
        by: impl FnOnce(N) -> N,
    ) -> Result<(), AssignmentError> {
        debug_assert!(column < self.costs.columns(), "a column of the table");
        let Some(price) = self.memory.prices.get_mut(column) else { return Ok(()) };
        *price = by(*price);
        if *price > N::ZERO.minus(N::ROOM) { Ok(()) } else { Err(AssignmentError::TooLarge) }
    }

    /// A row at the current prices.
    pub(super) fn row(&self, row: usize) -> Row<'_, N> {
        Row::new(self.costs, row, self.memory.prices)
    }

    /// The reduction of columns: each costs what it costs its cheapest row, and that row has it
    /// unless it has another. Only where each column is needed, as these prices are above 0. Then
    /// each of these rows lowers the price of its column by what the second one is worse.
    fn reduce_columns(&mut self) -> Result<(), AssignmentError> {
        let Memory { prices, before, done, .. } = &mut self.memory;
        done.fill(0); // what each column costs its cheapest row, as that is stored
        for row in 0..self.costs.rows() {
            cheapest(self.costs.entries(row), row as u32, done, before);
        }
        for (price, stored) in prices.iter_mut().zip(done.iter()) {
            let cost = N::twice(Cost::from_stored(*stored), self.costs.least());
            *price = cost.unwrap_or(N::FAR);
        }
        done.fill(0); // of how many columns a row is the cheapest
        for column in (0..self.costs.columns()).rev() {
            let row = self.memory.before.get(column).copied().unwrap_or(0);
            let missing = self.memory.prices.get(column).is_none_or(|it| *it == N::FAR);
            if missing {
                self.reprice(column, |_| N::ZERO)?;
                continue;
            }
            debug_assert!((row as usize) < self.costs.rows(), "a row of the table");
            if let Some(it) = self.memory.done.get_mut(row as usize) {
                *it = it.wrapping_add(1);
            }
            if self.memory.column(row as usize).is_none() {
                self.give(row, column);
                self.reprice(column, |it| it.minus(N::HALF))?;
            }
        }
        for row in 0..self.costs.rows() {
            let Some(column) = self.memory.column(row) else { continue };
            if self.memory.done.get(row) != Some(&1) {
                continue;
            }
            let nearest = self.row(row).two_nearest();
            let other = if nearest.column == Some(column) { nearest.second } else { nearest.away };
            if other != N::FAR {
                self.reprice(column, |it| it.minus(other.whole()))?;
            }
        }
        Ok(())
    }

    /// The reduction of rows, once: a row takes the column that is nearest, and lowers its price by
    /// as much as the second one is further, which may push another row out. Where a row has one
    /// column only nothing tells what that is worth, and the rest is left to the paths.
    fn reduce_rows(&mut self) -> Result<(), AssignmentError> {
        let mut steps = self.costs.rows().saturating_mul(4);
        for row in 0..self.costs.rows() {
            let mut open = row;
            let (mut level, mut lost) = (LEVEL, row);
            while self.memory.column(open).is_none() {
                let Some(left) = steps.checked_sub(1) else { return Ok(()) };
                steps = left;
                let Nearest { away, column, second } = self.row(open).two_nearest();
                if away == N::FAR {
                    return Err(self.conflict(open, 0));
                }
                let free = away == away.whole();
                let gain = match second {
                    it if it == N::FAR => N::ZERO,
                    it => it.whole().minus(away.whole()),
                };
                if !free && gain == N::ZERO {
                    // To push somebody out without gain may go on for ever.
                    let Some(left) = level.checked_sub(1) else { break };
                    level = left;
                }
                // Among equal columns the first free one is taken, or the next one that is not.
                let behind = if free { usize::MAX } else { lost };
                let column = column.unwrap_or_else(|| self.row(open).next_equal(away, behind));
                lost = column;
                let pushed = self.memory.row(column);
                let taken = if free { N::HALF } else { N::ZERO };
                self.reprice(column, |it| it.minus(gain).minus(taken))?;
                self.give(open as u32, column);
                let Some(pushed) = pushed else { break };
                put(self.memory.column_of, pushed, 0);
                open = pushed;
            }
        }
        Ok(())
    }

    /// A shortest path of exchanges from a row without a column to a column without a row.
    pub(super) fn grow(&mut self, from: u32) -> Result<(), AssignmentError> {
        self.memory.distances.fill(N::FAR);
        let nearest = self.reach(from as usize, N::ZERO);
        self.grow_on(from, 0, nearest)
    }

    /// The nearest column that is not done, and how far it is, once it is known how far columns are
    /// by a row to which it costs so much to come.
    fn reach(&mut self, row: usize, base: N) -> (N, usize) {
        let prices = Row::new(self.costs, row, self.memory.prices);
        let by = Reach { row: prices, base, from: row as u32 };
        reach(&by, self.memory.distances, self.memory.before)
    }

    /// Returns the cost to come to the row that has a column to which it costs so much.
    pub(super) fn base(&self, row: usize, column: usize, away: N) -> Result<N, AssignmentError> {
        // The row gives this column back, and what it pays for it.
        debug_assert!(self.entry(row, column).is_some(), "a row has a column that it can have");
        let own = N::twice(self.entry(row, column), 1).unwrap_or(N::ZERO);
        let price = self.memory.prices.get(column).copied().unwrap_or(N::ZERO);
        let base = away.minus(own.minus(price));
        if base < N::ROOM.plus(N::ROOM) { Ok(base) } else { Err(AssignmentError::TooLarge) }
    }

    /// The rest of a shortest path when so many columns are done.
    pub(super) fn grow_on(
        &mut self,
        from: u32,
        mut met: usize,
        (mut away, mut column): (N, usize),
    ) -> Result<(), AssignmentError> {
        let (end, length) = loop {
            if away == N::FAR {
                return Err(self.conflict(from as usize, met));
            }
            let Some(next) = self.memory.row(column) else { break (column, away) };
            debug_assert!(met < self.costs.columns(), "each column is done once");
            self.settle(column, met, away);
            let base = self.base(next, column, away)?;
            (away, column) = self.reach(next, base);
            met = met.wrapping_add(1);
        };
        let mut lowest = N::ZERO;
        let ends = self.memory.done.iter().zip(self.memory.lengths.iter());
        for (column, at) in ends.take(met) {
            if let Some(price) = self.memory.prices.get_mut(*column as usize) {
                *price = price.plus(at.whole()).minus(length);
                lowest = lowest.min(*price);
            }
        }
        if lowest <= N::ZERO.minus(N::ROOM) {
            return Err(AssignmentError::TooLarge);
        }
        self.reprice(end, |it| it.minus(N::HALF))?;
        self.exchange(from, end, met);
        Ok(())
    }

    /// The shortest path to a column that somebody has is known.
    pub(super) fn settle(&mut self, column: usize, number: usize, length: N) {
        put(self.memory.done, number, column as u32);
        put(self.memory.lengths, number, length);
        put(self.memory.distances, column, N::DONE);
    }

    /// An entry of the table.
    pub(super) fn entry(&self, row: usize, column: usize) -> Option<Cost> {
        self.costs.entries(row).get(column).copied().flatten()
    }

    /// There are more rows than columns.
    pub(super) fn all_in_conflict(&mut self) -> AssignmentError {
        self.memory.conflict.fill(1);
        let (rows, columns) = conflict(self.costs, |_| true);
        AssignmentError::Infeasible { rows, columns }
    }

    /// Along a path over so many columns that somebody has, each row takes the next column.
    pub(super) fn exchange(&mut self, from: u32, end: usize, over: usize) {
        debug_assert!(over < self.costs.rows(), "a row has one column at most");
        let mut column = end;
        for _ in 0..=over {
            debug_assert!(column < self.costs.columns(), "a column of the table");
            let Some(row) = self.memory.before.get(column).copied() else { return };
            let next = self.memory.column(row as usize);
            self.give(row, column);
            let Some(next) = next.filter(|_| row != from) else { return };
            column = next;
        }
    }

    /// The rows that have the first `met` columns done, and the one that finds no other, are in
    /// conflict.
    pub(super) fn conflict(&mut self, from: usize, met: usize) -> AssignmentError {
        let Memory { row_of, conflict, done, .. } = &mut self.memory;
        conflict.fill(0);
        debug_assert!(met <= done.len() && from < conflict.len(), "rows and columns of the table");
        let rows = done.iter().take(met).filter_map(|it| row_of.get(*it as usize));
        for row in rows.filter_map(|it| it.checked_sub(1)).chain([from as u32]) {
            put(conflict, row as usize, 1);
        }
        AssignmentError::Infeasible { rows: met.saturating_add(1), columns: met }
    }

    /// Prices of columns that are all needed may be above 0: all fall alike until none is.
    fn lower_prices(&mut self) {
        let half = |it: &N| it.plus(N::HALF).whole();
        let most = self.memory.prices.iter().map(half).fold(N::ZERO, N::max);
        if most > N::ZERO {
            self.memory.prices.iter_mut().for_each(|it| *it = it.minus(most));
        }
    }
}
