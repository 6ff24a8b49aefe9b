//! Assignment: each row gets a column of its own, at the least sum of costs.
//!
//! Rows are added one at a time, each along a shortest path of exchanges (R. Jonker and A.
//! Volgenant, *A shortest augmenting path algorithm for dense and sparse linear assignment
//! problems*, Computing 38, 1987; their reduction of rows comes first, with as many steps as it may
//! take). Prices of columns prove the answer: see [`Assigned`].

use super::cost::{Cost, Costs};

/// What is remembered of a row; as many as there are rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// Its column, one more than its number; none while it waits.
    column: u32,
}

impl Row {
    /// Its column, once it has one.
    pub fn column(&self) -> Option<usize> {
        self.column.checked_sub(1).map(|it| it as usize)
    }
}

/// What is remembered of a column; as many as there are columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// What it is worth to its row beside the cost: at most 0, and 0 while nobody has it.
    price: i64,
    /// The length of the shortest path to it, while one is looked for.
    distance: i64,
    /// The row that has it, one more than its number; 0 for none.
    row: u32,
    /// The row that comes before it on the path.
    before: u32,
    /// Its distance is final.
    done: bool,
}

impl Column {
    /// The row that has it.
    pub fn row(&self) -> Option<usize> {
        self.row.checked_sub(1).map(|it| it as usize)
    }

    /// Its price: at most 0, and 0 if nobody has it.
    pub const fn price(&self) -> i64 {
        self.price
    }
}

/// An assignment of least cost.
///
/// It is proven by the prices: no edge costs less than the price of its row and of its column, an
/// assigned edge costs exactly that, and a column that nobody has costs nothing. So whoever assigns
/// all rows pays at least the sum of all prices, which is the total.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Assigned {
    /// The sum of the costs.
    pub total: u64,
}

/// No assignment gives each row a column: some rows have, all together, fewer columns than they are
/// (P. Hall 1935).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Infeasible {
    /// How many rows are in conflict; [`in_conflict`](Infeasible::in_conflict) tells which.
    pub rows: usize,
    /// How many columns these rows could have.
    pub columns: usize,
    /// The row that found none.
    row: u32,
}

impl Infeasible {
    /// Whether a row is one of those in conflict.
    pub fn in_conflict(&self, row: usize, columns: &[Column]) -> bool {
        let number = row as u32;
        number == self.row || columns.iter().any(|it| it.done && it.row() == Some(row))
    }
}

/// No path comes here yet.
const FAR: i64 = i64::MAX;

/// Assigns each row a column at the least total. `rows` and `columns` are as long as the table has
/// rows and columns, and hold the assignment and the prices afterwards.
///
/// ```
/// use cotama_core::team::{Column, Cost, Costs, Row, assign};
/// let costs = [4, 1, 3, 2, 0, 5].map(Cost::new);
/// let table = Costs::new(&costs, 3).unwrap();
/// let (mut rows, mut columns) = ([Row::default(); 2], [Column::default(); 3]);
/// let assigned = assign(&table, &mut rows, &mut columns).unwrap();
/// assert_eq!((assigned.total, rows.map(|it| it.column())), (3, [Some(1), Some(0)]));
/// ```
///
/// # Errors
/// [`Infeasible`], with the rows in conflict, where there is none. With too little memory for the
/// table its last row or column counts as missing.
pub fn assign(
    costs: &Costs<'_>,
    rows: &mut [Row],
    columns: &mut [Column],
) -> Result<Assigned, Infeasible> {
    rows.fill(Row::default());
    columns.fill(Column::default());
    for row in 0..costs.rows() {
        reduce(costs, row as u32, rows, columns);
    }
    for row in 0..costs.rows() {
        if rows.get(row).is_some_and(|it| it.column == 0) {
            grow(costs, row as u32, rows, columns)?;
        }
    }
    let cost = |(row, it): (usize, &Row)| {
        let entry = it.column().and_then(|it| costs.row(row).get(it)).copied().flatten();
        entry.map_or(0, |it| u64::from(it.get()))
    };
    Ok(Assigned { total: rows.iter().enumerate().map(cost).fold(0, u64::saturating_add) })
}

/// The reduction of a row: it takes the column that is cheapest for it, and lowers the price of that
/// column by as much as the second one is worse, which may push another row out. Where it goes on
/// for long, or a row has one column only, the rest is left to the paths.
fn reduce(costs: &Costs<'_>, row: u32, rows: &mut [Row], columns: &mut [Column]) {
    let mut open = row;
    for _ in 0..8 {
        let Some(best) = two_best(costs.row(open as usize), columns) else { return };
        let Some(second) = best.second else {
            // Its only column: nothing tells what that is worth.
            if let Some(column) = columns.get_mut(best.column).filter(|it| it.row == 0) {
                give(rows, column, open, best.column);
            }
            return;
        };
        let gain = second.0.saturating_sub(best.least);
        let at = if gain == 0 && columns.get(best.column).is_some_and(|it| it.row > 0) {
            second.1
        } else {
            best.column
        };
        let Some(column) = columns.get_mut(at) else { return };
        let pushed = column.row;
        if pushed > 0 && gain == 0 {
            return; // to push somebody out without gain may go on for ever
        }
        if at == best.column {
            column.price = column.price.saturating_sub(gain);
        }
        give(rows, column, open, at);
        let Some(next) = pushed.checked_sub(1) else { return };
        if let Some(it) = rows.get_mut(next as usize) {
            it.column = 0;
        }
        open = next;
    }
}

/// A row gets a column.
fn give(rows: &mut [Row], column: &mut Column, row: u32, at: usize) {
    column.row = row.saturating_add(1);
    if let Some(it) = rows.get_mut(row as usize) {
        it.column = (at as u32).saturating_add(1);
    }
}

/// The cheapest column of a row and the second cheapest, less their prices.
struct Best {
    least: i64,
    column: usize,
    second: Option<(i64, usize)>,
}

fn two_best(row: &[Option<Cost>], columns: &[Column]) -> Option<Best> {
    let mut best: Option<Best> = None;
    for (at, (cost, column)) in row.iter().zip(columns).enumerate() {
        let Some(cost) = cost else { continue };
        let value = i64::from(cost.get()).saturating_sub(column.price);
        best = Some(match best {
            None => Best { least: value, column: at, second: None },
            Some(it) if value < it.least => {
                Best { least: value, column: at, second: Some((it.least, it.column)) }
            }
            Some(it) if it.second.is_none_or(|second| value < second.0) => {
                Best { second: Some((value, at)), ..it }
            }
            Some(it) => it,
        });
    }
    best
}

/// A shortest path of exchanges from a row without a column to a column without a row.
fn grow(
    costs: &Costs<'_>,
    from: u32,
    rows: &mut [Row],
    columns: &mut [Column],
) -> Result<(), Infeasible> {
    for it in columns.iter_mut() {
        (it.distance, it.done) = (FAR, false);
    }
    // The row that is looked at, and what it costs to come to it, less the price of its own edge.
    let (mut row, mut base, mut met) = (from, 0_i64, 1_usize);
    let (end, length) = loop {
        let mut nearest: Option<(usize, i64)> = None;
        for (at, (cost, column)) in
            costs.row(row as usize).iter().zip(columns.iter_mut()).enumerate()
        {
            if column.done {
                continue;
            }
            if let Some(cost) = cost {
                let value = i64::from(cost.get()).saturating_sub(column.price);
                let length = base.saturating_add(value);
                if length < column.distance {
                    (column.distance, column.before) = (length, row);
                }
            }
            if column.distance < nearest.map_or(FAR, |it| it.1) {
                nearest = Some((at, column.distance));
            }
        }
        let Some((at, length)) = nearest else {
            return Err(Infeasible { rows: met, columns: met.saturating_sub(1), row: from });
        };
        let Some(column) = columns.get_mut(at) else { continue };
        let Some(next) = column.row.checked_sub(1) else { break (at, length) };
        column.done = true;
        // Its row pays for it what the path to it costs.
        let own = costs.row(next as usize).get(at).copied().flatten();
        let own = own.map_or(0, |it| i64::from(it.get()).saturating_sub(column.price));
        (row, base, met) = (next, length.saturating_sub(own), met.saturating_add(1));
    };
    for it in columns.iter_mut().filter(|it| it.done) {
        it.price = it.price.saturating_add(it.distance.saturating_sub(length));
        it.done = false;
    }
    // Along the path each row takes the next column.
    let mut at = end;
    for _ in 0..=met {
        let Some(column) = columns.get_mut(at) else { break };
        let row = column.before;
        column.row = row.saturating_add(1);
        let Some(it) = rows.get_mut(row as usize) else { break };
        let next = core::mem::replace(&mut it.column, (at as u32).saturating_add(1));
        if row == from {
            break;
        }
        let Some(next) = next.checked_sub(1) else { break };
        at = next as usize;
    }
    Ok(())
}
