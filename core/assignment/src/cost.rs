//! Costs of a robot in a role.

use core::num::NonZeroI32;

/// A cost of at most [`Cost::MOST`]. Who cannot do something has none: `Option<Cost>` is as small
/// as a cost, and no large number stands for "never".
///
/// ```
/// use cotama_core::team::Cost;
/// assert_eq!(Cost::new(7).map(Cost::get), Some(7));
/// assert_eq!(Cost::new(Cost::MOST + 1), None);
/// assert!(Cost::new(2) < Cost::new(3));
/// assert_eq!(size_of::<Option<Cost>>(), 4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cost(NonZeroI32);

impl Cost {
    /// The largest cost: 2,147,483,645.
    pub const MOST: u32 = Self::TOP as u32 - 1;
    /// The stored form of cost 0: there is one more, as a limit that nothing meets.
    const TOP: i32 = i32::MAX - 1;

    /// The cost of this number, unless that is above [`Cost::MOST`].
    #[must_use]
    pub const fn new(number: u32) -> Option<Self> {
        // Stored upside down: what is missing lies below every cost, so one comparison finds what
        // is missing and what is above a limit.
        if number > Self::MOST {
            return None;
        }
        debug_assert!(number.cast_signed() < Self::TOP, "the stored form is not 0");
        match NonZeroI32::new(Self::TOP.wrapping_sub(number.cast_signed())) {
            Some(it) => Some(Self(it)),
            None => None,
        }
    }

    /// Returns the cost as a number.
    pub const fn get(self) -> u32 {
        Self::number(self.0.get()).cast_unsigned()
    }

    /// The number of what is stored as this.
    #[inline]
    pub(super) const fn number(stored: i32) -> i32 {
        Self::TOP.wrapping_sub(stored)
    }

    /// Returns the cost stored as this number; `None` for 0.
    #[inline]
    pub(super) const fn from_stored(stored: u32) -> Option<Self> {
        match NonZeroI32::new(stored.cast_signed()) {
            Some(it) => Some(Self(it)),
            None => None,
        }
    }

    /// Returns the stored form of an entry; 0 for a missing one.
    #[inline]
    pub(super) const fn upside_down(entry: Option<Self>) -> i32 {
        match entry {
            Some(it) => it.0.get(),
            None => 0,
        }
    }
}

impl PartialOrd for Cost {
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Cost {
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        other.0.cmp(&self.0)
    }
}

/// A table of costs: each row is one that needs a column, as a role needs a robot.
///
/// ```
/// use cotama_core::team::{Cost, Costs};
/// let entries = [Cost::new(4), None, Cost::new(3), Cost::new(2)];
/// let table = Costs::new(&entries, 2).unwrap();
/// assert_eq!((table.rows(), table.columns()), (2, 2));
/// assert_eq!(table.cost(1, 0), Cost::new(3));
/// assert_eq!(table.at_most(Cost::new(2).unwrap()).cost(1, 0), None);
/// assert!(Costs::new(&entries, 3).is_none());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Costs<'a> {
    entries: &'a [Option<Cost>],
    columns: usize,
    /// An entry counts if it is stored as this or more; 1 or more.
    least: i32,
    /// No entry that counts is stored as less.
    lowest: i32,
    /// Whether an entry may be missing.
    lacks_any: bool,
}

impl<'a> Costs<'a> {
    /// A table of so many columns, row after row; none where the rows are not whole.
    #[must_use]
    pub fn new(entries: &'a [Option<Cost>], columns: usize) -> Option<Self> {
        let whole = entries.len().checked_rem(columns) == Some(0);
        let stored = |it: &Option<Cost>| match Cost::upside_down(*it) {
            0 => Cost::TOP,
            it => it,
        };
        let lowest = entries.iter().map(stored).fold(Cost::TOP, i32::min);
        let lacks_any = entries.iter().fold(false, |lacks, it| lacks | it.is_none());
        let table = Self { entries, columns, least: 1, lowest, lacks_any };
        (whole || entries.is_empty()).then_some(table)
    }

    /// The same table, in which everything above `limit` is missing.
    #[must_use]
    pub fn at_most(self, limit: Cost) -> Self {
        self.stored_from(limit.0.get())
    }

    /// The same table, in which everything of `limit` or above is missing.
    #[must_use]
    pub fn below(self, limit: Cost) -> Self {
        self.stored_from(limit.0.get().saturating_add(1))
    }

    fn stored_from(self, least: i32) -> Self {
        let least = least.max(self.least);
        debug_assert!(least >= 1, "what is missing is stored as 0 and does not count");
        let lacks_any = self.lacks_any || self.lowest < least;
        Self { least, lowest: self.lowest.max(least).min(Cost::TOP), lacks_any, ..self }
    }

    /// No cost is above this.
    pub const fn most(&self) -> u32 {
        Cost::number(self.lowest).cast_unsigned()
    }

    /// Whether an entry may be missing.
    pub(super) const fn lacks_any(&self) -> bool {
        self.lacks_any
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.entries.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Returns the number of columns.
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// Returns the cost of a column for a row; `None` where it is missing, or there is no such
    /// place.
    pub fn cost(&self, row: usize, column: usize) -> Option<Cost> {
        let entry = self.entries(row).get(column).copied().flatten();
        entry.filter(|it| it.0.get() >= self.least)
    }

    /// The costs of a row, column by column; nothing where there is no such row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = Option<Cost>> + use<'a> {
        let least = self.least;
        self.entries(row).iter().map(move |it| it.filter(|it| it.0.get() >= least))
    }

    /// The entries of a row, also those above the limit.
    #[inline]
    pub(super) fn entries(&self, row: usize) -> &'a [Option<Cost>] {
        let from = row.saturating_mul(self.columns);
        self.entries.get(from..from.saturating_add(self.columns)).unwrap_or(&[])
    }

    /// The least that an entry is stored as to count.
    #[inline]
    pub(super) const fn least(&self) -> i32 {
        self.least
    }
}
