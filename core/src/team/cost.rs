//! What it costs that somebody does something.

use core::num::NonZeroU32;

/// A cost below [`u32::MAX`]. Who cannot do something has none: `Option<Cost>` is as small as a
/// cost, and no large number stands for "never".
///
/// ```
/// use cotama_core::team::Cost;
/// assert_eq!(Cost::new(7).map(Cost::get), Some(7));
/// assert_eq!(Cost::new(u32::MAX), None);
/// assert_eq!(size_of::<Option<Cost>>(), 4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cost(NonZeroU32);

impl Cost {
    /// The cost of this number, unless that is [`u32::MAX`].
    #[must_use]
    pub const fn new(number: u32) -> Option<Self> {
        match NonZeroU32::new(number.wrapping_add(1)) {
            Some(it) => Some(Self(it)),
            None => None,
        }
    }

    /// Its number.
    pub const fn get(self) -> u32 {
        self.0.get().wrapping_sub(1)
    }
}

/// A table of costs: each row is one that needs a column, as a role needs a robot.
#[derive(Clone, Copy, Debug)]
pub struct Costs<'a> {
    entries: &'a [Option<Cost>],
    columns: usize,
}

impl<'a> Costs<'a> {
    /// A table of so many columns, row after row; none where the rows are not whole.
    #[must_use]
    pub fn new(entries: &'a [Option<Cost>], columns: usize) -> Option<Self> {
        let whole = entries.len().checked_rem(columns) == Some(0);
        (whole || entries.is_empty()).then_some(Self { entries, columns })
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.entries.len().checked_div(self.columns).unwrap_or(0)
    }

    /// How many columns.
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// The costs of a row; empty where there is no such row.
    pub fn row(&self, row: usize) -> &'a [Option<Cost>] {
        let from = row.saturating_mul(self.columns);
        self.entries.get(from..from.saturating_add(self.columns)).unwrap_or(&[])
    }
}
