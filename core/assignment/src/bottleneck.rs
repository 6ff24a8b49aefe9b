//! Bottleneck assignment: each row gets a column of its own, the dearest of these as cheap as can
//! be; and of all such assignments one of the least sum.
//!
//! U. Derigs and U. Zimmermann, *An augmenting path method for solving linear bottleneck assignment
//! problems*, Computing 19, 1978: each row joins along a path whose dearest edge is as cheap as can
//! be. The rows that are met before the bound rises for the last time prove it: below the bound
//! they have fewer columns than they are.

use super::amount::Amount;
use super::assignment::{AssignmentError, MANY, Work};
use super::cost::{Cost, Costs};
use super::memory::Memory;
use super::scan::{Reach, Row, reach};

/// A bottleneck assignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bottleneck {
    /// The largest cost in it; none without rows.
    pub largest: Option<Cost>,
    /// The sum of its costs.
    pub total: u64,
}

/// Assigns each row a column, so that the largest cost is the least; of all these assignments one
/// with the least total.
///
/// [`Memory::in_conflict`] tells the rows that prove the largest cost: below it they have fewer
/// columns than they are, as [`conflict`](super::conflict) counts again in [`Costs::below`] it. The
/// prices prove the total in [`Costs::at_most`] it.
///
/// ```
/// use cotama_core::team::{Cost, Costs, Fixed, bottleneck, conflict};
/// let entries = [1, 9, 2, 11].map(Cost::new); // 1 and 11 are less together than 9 and 2
/// let table = Costs::new(&entries, 2).unwrap();
/// let mut fixed = Fixed::<i32, 2, 2>::new();
/// let mut memory = fixed.memory();
/// let found = bottleneck(&table, &mut memory).unwrap();
/// assert_eq!((found.largest, found.total), (Cost::new(9), 11));
/// let cheaper = table.below(Cost::new(9).unwrap());
/// assert_eq!(conflict(&cheaper, |row| memory.in_conflict(row)), (2, 1));
/// ```
///
/// # Errors
/// As [`assign`](super::assign).
#[inline]
pub fn bottleneck<N: Amount>(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, N>,
) -> Result<Bottleneck, AssignmentError> {
    // As an assignment has it.
    if memory.size().0 < MANY {
        bottleneck_sized::<N, false>(costs, memory)
    } else {
        bottleneck_sized::<N, true>(costs, memory)
    }
}

#[inline(never)]
fn bottleneck_sized<N: Amount, const LARGE: bool>(
    costs: &Costs<'_>,
    memory: &mut Memory<'_, N>,
) -> Result<Bottleneck, AssignmentError> {
    let mut work = Work::start(costs, memory)?;
    work.memory.conflict.fill(0);
    if costs.rows() > costs.columns() {
        return Err(work.all_in_conflict());
    }
    let mut largest = None;
    for row in 0..costs.rows() {
        work.widen(row as u32, &mut largest)?;
    }
    let within = largest.map_or(*costs, |it| costs.at_most(it));
    let total = Work::start(&within, memory)?.assign::<LARGE>()?;
    Ok(Bottleneck { largest, total })
}

impl<N: Amount> Work<'_, N> {
    /// A row joins along a path whose dearest edge is as cheap as can be. Prices are 0 all along.
    fn widen(&mut self, from: u32, largest: &mut Option<Cost>) -> Result<(), AssignmentError> {
        self.memory.distances.fill(N::FAR);
        let (mut row, mut met) = (from, 0_usize);
        let end = loop {
            let prices = Row::new(self.costs, row as usize, self.memory.prices);
            let by = Reach { row: prices, base: N::ZERO, from: row };
            let (away, column) = reach(&by, self.memory.distances, self.memory.before);
            if away == N::FAR {
                return Err(self.conflict(from as usize, met));
            }
            let before = self.memory.before.get(column).copied().unwrap_or(from);
            let cost = self.entry(before as usize, column);
            debug_assert!(cost.is_some(), "a path leads to a column that its row can have");
            if cost > *largest {
                // With less than this the rows met so far come no further.
                self.conflict(from as usize, met);
                *largest = cost;
            }
            let Some(next) = self.memory.row(column) else { break column };
            self.settle(column, met, away);
            (row, met) = (next as u32, met.wrapping_add(1));
        };
        if let Some(price) = self.memory.prices.get_mut(end) {
            *price = N::ZERO.minus(N::HALF);
        }
        self.exchange(from, end, met);
        Ok(())
    }
}
