//! The memory in which an assignment is computed, and which holds it afterwards.

use super::amount::Amount;
use cotama_units::memory::{MemoryError, enough};

/// The memory for tables of up to so many rows and columns, as slices of the caller's; the result
/// of the last assignment is read from it.
///
/// ```
/// use cotama_core::team::Memory;
/// let (rows, columns) = (1_000, 2_000);
/// let mut words = vec![0; Memory::<i32>::words(rows, columns)];
/// let mut amounts = vec![0; Memory::<i32>::amounts(columns)];
/// assert!(Memory::new(rows, columns, &mut words, &mut amounts).is_ok());
/// assert!(Memory::new(rows, 3_000, &mut words, &mut amounts).is_err());
/// ```
#[derive(Debug)]
pub struct Memory<'m, N> {
    /// The column of each row, one more than its number; 0 for none.
    pub(super) column_of: &'m mut [u32],
    /// The last bit: whether a row is in conflict. The others: one more than a column that nobody
    /// has and that is as near as the row's own, as far as that is known.
    pub(super) conflict: &'m mut [u32],
    /// The row of each column, one more than its number; 0 for none.
    pub(super) row_of: &'m mut [u32],
    /// The row that comes before a column on the shortest path to it.
    pub(super) before: &'m mut [u32],
    /// Columns whose shortest path is known, in the order of its length; and that length.
    pub(super) done: &'m mut [u32],
    pub(super) lengths: &'m mut [N],
    /// Twice what a column is worth to its row beside the cost, less one if somebody has it.
    pub(super) prices: &'m mut [N],
    /// Twice the length of the shortest path to a column so far.
    pub(super) distances: &'m mut [N],
}

impl<'m, N: Amount> Memory<'m, N> {
    /// How many words a table of so many rows and columns takes.
    #[must_use]
    pub const fn words(rows: usize, columns: usize) -> usize {
        rows.saturating_mul(2).saturating_add(columns.saturating_mul(3))
    }

    /// How many amounts a table of so many columns takes.
    #[must_use]
    pub const fn amounts(columns: usize) -> usize {
        columns.saturating_mul(3)
    }

    /// The memory for so many rows and columns.
    ///
    /// # Errors
    /// [`MemoryError`] where a slice is shorter than [`words`](Memory::words) or
    /// [`amounts`](Memory::amounts).
    pub fn new(
        rows: usize,
        columns: usize,
        words: &'m mut [u32],
        amounts: &'m mut [N],
    ) -> Result<Self, MemoryError> {
        let (some, least) = (words.len(), amounts.len());
        Self::split(rows, columns, words, amounts).ok_or_else(|| {
            let words = enough("words of the assignment", Self::words(rows, columns), some);
            let amounts = enough("amounts of the assignment", Self::amounts(columns), least);
            let unknown = MemoryError { what: "assignment", needed: usize::MAX, given: some };
            words.and(amounts).err().unwrap_or(unknown)
        })
    }

    fn split(
        rows: usize,
        columns: usize,
        words: &'m mut [u32],
        amounts: &'m mut [N],
    ) -> Option<Self> {
        let (column_of, words) = words.split_at_mut_checked(rows)?;
        let (conflict, words) = words.split_at_mut_checked(rows)?;
        let (row_of, words) = words.split_at_mut_checked(columns)?;
        let (before, words) = words.split_at_mut_checked(columns)?;
        let done = words.get_mut(..columns)?;
        let (prices, amounts) = amounts.split_at_mut_checked(columns)?;
        let (distances, amounts) = amounts.split_at_mut_checked(columns)?;
        let lengths = amounts.get_mut(..columns)?;
        Some(Self { column_of, conflict, row_of, before, done, lengths, prices, distances })
    }

    /// The same memory for a smaller table, empty.
    pub(super) fn cleared(&mut self, rows: usize, columns: usize) -> Option<Memory<'_, N>> {
        let it = Memory {
            column_of: self.column_of.get_mut(..rows)?,
            conflict: self.conflict.get_mut(..rows)?,
            row_of: self.row_of.get_mut(..columns)?,
            before: self.before.get_mut(..columns)?,
            done: self.done.get_mut(..columns)?,
            lengths: self.lengths.get_mut(..columns)?,
            prices: self.prices.get_mut(..columns)?,
            distances: self.distances.get_mut(..columns)?,
        };
        it.column_of.fill(0);
        it.row_of.fill(0);
        it.prices.fill(N::ZERO);
        Some(it)
    }

    /// How many rows and columns there is memory for.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.column_of.len(), self.row_of.len())
    }

    /// The column that a row has.
    pub fn column(&self, row: usize) -> Option<usize> {
        number(self.column_of, row)
    }

    /// The row that has a column.
    pub fn row(&self, column: usize) -> Option<usize> {
        number(self.row_of, column)
    }

    /// The price of a column: at most 0, and 0 if nobody has it. See
    /// [`is_least`](super::is_least).
    pub fn price(&self, column: usize) -> i64 {
        let taken = self.row(column).map_or(N::ZERO, |_| N::HALF);
        self.prices.get(column).map_or(0, |it| it.plus(taken).halved())
    }

    /// Whether a row is one of those in conflict, after
    /// [`Infeasible`](super::AssignmentError::Infeasible) or a bottleneck.
    pub fn in_conflict(&self, row: usize) -> bool {
        self.conflict.get(row).is_some_and(|it| *it & 1 != 0)
    }
}

/// Writes at a place.
#[inline]
pub(super) fn put<T>(list: &mut [T], at: usize, it: T) {
    debug_assert!(at < list.len(), "a place of the list");
    if let Some(place) = list.get_mut(at) {
        *place = it;
    }
}

/// The number that is stored one higher; none for 0.
#[inline]
pub(super) fn number(list: &[u32], at: usize) -> Option<usize> {
    list.get(at)?.checked_sub(1).map(|it| it as usize)
}

/// The memory for tables of up to `R` rows and `C` columns.
///
/// ```
/// use cotama_core::team::{Cost, Costs, Fixed, assign};
/// let costs = [4, 1, 3, 2, 0, 5].map(Cost::new);
/// let table = Costs::new(&costs, 3).unwrap();
/// let mut fixed = Fixed::<i32, 2, 3>::new();
/// let mut memory = fixed.memory();
/// assert_eq!(assign(&table, &mut memory), Ok(3));
/// assert_eq!((memory.column(0), memory.column(1)), (Some(1), Some(0)));
/// ```
#[derive(Clone, Debug)]
pub struct Fixed<N, const R: usize, const C: usize> {
    rows: [[u32; R]; 2],
    columns: [[u32; C]; 3],
    amounts: [[N; C]; 3],
}

impl<N: Amount, const R: usize, const C: usize> Fixed<N, R, C> {
    /// Unused memory.
    #[must_use]
    pub const fn new() -> Self {
        Self { rows: [[0; R]; 2], columns: [[0; C]; 3], amounts: [[N::ZERO; C]; 3] }
    }

    /// The memory, for assignments.
    pub const fn memory(&mut self) -> Memory<'_, N> {
        let ([column_of, conflict], [row_of, before, done]) = (&mut self.rows, &mut self.columns);
        let [prices, distances, lengths] = &mut self.amounts;
        Memory { column_of, conflict, row_of, before, done, lengths, prices, distances }
    }
}

impl<N: Amount, const R: usize, const C: usize> Default for Fixed<N, R, C> {
    fn default() -> Self {
        Self::new()
    }
}
