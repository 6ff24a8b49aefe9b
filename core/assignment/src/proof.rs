//! Checks of assignments that know nothing of how they were found.

use super::cost::{Cost, Costs};

/// Why prices do not prove an assignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProofError {
    /// This row has no column, or one that it cannot have.
    NoColumn {
        /// The row.
        row: usize,
    },
    /// Two rows have this column.
    Shared {
        /// The column.
        column: usize,
    },
    /// The price of this column is above 0, or is not 0 although nobody has it.
    Price {
        /// The column.
        column: usize,
    },
    /// At these prices this row has a better column than its own.
    Better {
        /// The row.
        row: usize,
        /// The better column.
        column: usize,
    },
}

impl core::fmt::Display for ProofError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoColumn { row } => write!(f, "row {row} has no column that it can have"),
            Self::Shared { column } => write!(f, "two rows have column {column}"),
            Self::Price { column } => {
                write!(f, "the price of column {column} is above 0, or nobody has it and it is not")
            }
            Self::Better { row, column } => {
                write!(f, "row {row} would be better off with column {column}")
            }
        }
    }
}

impl core::error::Error for ProofError {}

/// Proves that no assignment of these costs has a smaller total than this one, which is returned.
///
/// Each row has a column of its own that, less its price, costs the row no more than any other
/// column does; prices are at most 0, and 0 where nobody has the column. Whoever assigns all rows
/// pays for each row at least that least difference, and at least the sum of all prices: this is
/// what the assignment costs (duality of linear programming). In time rows × columns, and rows².
///
/// ```
/// use cotama_core::team::{Cost, Costs, ProofError, is_least};
/// let entries = [1, 5, 1, 3].map(Cost::new);
/// let table = Costs::new(&entries, 2).unwrap();
/// let (other, prices) = ([1, 0], [-2, 0]);
/// assert_eq!(is_least(&table, |row| Some(row), |column| prices[column]), Ok(4));
/// let better = ProofError::Better { row: 0, column: 0 };
/// assert_eq!(is_least(&table, |row| Some(other[row]), |column| prices[column]), Err(better));
/// ```
///
/// # Errors
/// The first [`ProofError`].
pub fn is_least(
    costs: &Costs<'_>,
    column_of: impl Fn(usize) -> Option<usize>,
    price_of: impl Fn(usize) -> i64,
) -> Result<u64, ProofError> {
    let mut total = 0_u64;
    for row in 0..costs.rows() {
        let own = column_of(row).and_then(|it| Some((it, costs.cost(row, it)?)));
        let Some((column, cost)) = own else { return Err(ProofError::NoColumn { row }) };
        if (0..row).any(|before| column_of(before) == Some(column)) {
            return Err(ProofError::Shared { column });
        }
        total = total.saturating_add(u64::from(cost.get()));
        let less = |cost: Cost, at| i64::from(cost.get()).saturating_sub(price_of(at));
        let own = less(cost, column);
        let better = |at: &usize| costs.cost(row, *at).is_some_and(|it| less(it, *at) < own);
        if let Some(column) = (0..costs.columns()).find(better) {
            return Err(ProofError::Better { row, column });
        }
    }
    let taken = |column| (0..costs.rows()).any(|row| column_of(row) == Some(column));
    let wrong = |column: &usize| match price_of(*column) {
        0 => false,
        price => price > 0 || !taken(*column),
    };
    match (0..costs.columns()).find(wrong) {
        Some(column) => Err(ProofError::Price { column }),
        None => Ok(total),
    }
}

/// How many rows these are, and how many columns they could have all together: where the columns
/// are fewer, no assignment gives each of the rows one.
///
/// ```
/// use cotama_core::team::{Cost, Costs, conflict};
/// let entries = [Cost::new(4), None, Cost::new(7), None, Cost::new(1), Cost::new(1)];
/// let table = Costs::new(&entries, 2).unwrap();
/// assert_eq!(conflict(&table, |row| row < 2), (2, 1));
/// ```
pub fn conflict(costs: &Costs<'_>, among: impl Fn(usize) -> bool) -> (usize, usize) {
    let rows = || (0..costs.rows()).filter(|it| among(*it));
    let could = |column: &usize| rows().any(|row| costs.cost(row, *column).is_some());
    let count = |sum: usize, _| sum.wrapping_add(1);
    (rows().fold(0, count), (0..costs.columns()).filter(could).fold(0, count))
}
