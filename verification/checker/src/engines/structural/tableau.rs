//! Linear programs in exact integers: the simplex method on rows without fractions.

use super::Limit;
use super::row::{Row, at, cancelling, combined};
use super::work::Work;
use std::sync::Arc;

/// The column of the right-hand side: the last one of a row.
const RIGHT: u32 = u32::MAX;
/// After so many steps that gain nothing the choice of columns cannot cycle any more.
const PATIENCE: u32 = 20;

/// Equations `sum of number * variable = right-hand side` over variables of at least zero.
///
/// Each row has a variable of its own, its basic variable, with a positive number, and multiples of
/// the equations at the start add up to it. In the point that the tableau stands for all other
/// variables are zero. A row whose right-hand side is negative is violated: its variable is.
#[derive(Clone, Debug, Default)]
pub(super) struct Tableau {
    rows: Vec<Arc<Row>>,
    /// For each row a bit for each of its columns modulo 64: most rows do not have a column, and
    /// this shows it quickly.
    masks: Vec<u64>,
    basic: Vec<u32>,
    /// For each variable the row in which it is basic.
    home: Vec<Option<u32>>,
}

/// The outcome of the attempt to increase a basic variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Raised {
    /// The variable is no longer negative; only when this was the aim.
    Feasible,
    /// No point has a larger value: in its row no number is negative, but maybe the right-hand
    /// side.
    Maximal,
    /// The variable has no largest value.
    Unbounded,
}

impl Tableau {
    /// A new variable, zero so far and in no row.
    pub(super) fn variable(&mut self) -> u32 {
        self.home.push(None);
        self.home.len() as u32 - 1
    }

    /// A new row with a new variable: `variable + sum of terms = right`. Its position.
    pub(super) fn add(
        &mut self,
        terms: &[(u32, i64)],
        right: i64,
        work: &mut Work,
    ) -> Result<usize, Limit> {
        let variable = self.variable();
        let mut row: Row = terms.to_vec();
        row.push((variable, 1));
        if right != 0 {
            row.push((RIGHT, right));
        }
        row = self.without_basic(row, work)?;
        self.home[variable as usize] = Some(self.rows.len() as u32);
        self.basic.push(variable);
        self.masks.push(mask(&row));
        self.rows.push(Arc::new(row));
        Ok(self.rows.len() - 1)
    }

    /// A new row without a new variable: `sum of terms = right`. One of its variables becomes
    /// basic, a preferred one if there is one. Says nothing when it follows from the others.
    pub(super) fn equate(
        &mut self,
        terms: &[(u32, i64)],
        right: i64,
        preferred: impl Fn(u32) -> bool,
        work: &mut Work,
    ) -> Result<(), Limit> {
        let mut row: Row = terms.to_vec();
        if right != 0 {
            row.push((RIGHT, right));
        }
        let row = self.without_basic(row, work)?;
        let variables = || row.iter().map(|it| it.0).filter(|&it| it != RIGHT);
        let Some(column) = variables().find(|&it| preferred(it)).or_else(|| variables().next())
        else {
            return Ok(());
        };
        self.masks.push(mask(&row));
        self.rows.push(Arc::new(row));
        self.basic.push(column);
        self.pivot(self.rows.len() - 1, column, work)
    }

    fn without_basic(&self, mut row: Row, work: &mut Work) -> Result<Row, Limit> {
        for (column, _) in row.clone() {
            if let Some(&Some(home)) = self.home.get(column as usize) {
                let home = &self.rows[home as usize];
                work.spend(row.len() + home.len())?;
                let (a, b) = cancelling(at(&row, column), at(home, column)).ok_or(Limit::Tokens)?;
                row = combined(&row, a, home, b).ok_or(Limit::Tokens)?;
            }
        }
        Ok(row)
    }

    /// How many rows there are.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Takes the row away that was added last, whose variable is still basic.
    pub(super) fn remove_last(&mut self) {
        debug_assert_eq!(self.basic.last().map(|it| *it as usize + 1), Some(self.home.len()));
        if self.rows.pop().is_some() {
            self.masks.pop();
            self.basic.pop();
            self.home.pop();
        }
    }

    /// The numbers of a row, and its right-hand side.
    pub(super) fn row(&self, row: usize) -> (&[(u32, i64)], i64) {
        match self.rows[row].split_last() {
            Some((&(RIGHT, right), terms)) => (terms, right),
            _ => (&self.rows[row], 0),
        }
    }

    /// The first violated row.
    pub(super) fn violated(&self, work: &mut Work) -> Result<Option<usize>, Limit> {
        work.pass(self.rows.len())?;
        Ok((0..self.rows.len()).find(|&it| self.row(it).1 < 0))
    }

    /// The value of a variable, as numerator and positive denominator.
    pub(super) fn value(&self, variable: u32) -> (i64, i64) {
        match self.home[variable as usize] {
            Some(home) => {
                let (terms, right) = self.row(home as usize);
                (right, at(terms, variable))
            }
            None => (0, 1),
        }
    }

    /// Increases the basic variable of a row, up to zero if `feasible`, otherwise as far as it
    /// goes. Rows that are not violated stay so. Each number that is looked at is one piece of
    /// `work`.
    pub(super) fn raise(
        &mut self,
        row: usize,
        feasible: bool,
        work: &mut Work,
    ) -> Result<Raised, Limit> {
        let mut wasted = 0;
        loop {
            let (terms, right) = self.row(row);
            if feasible && right >= 0 {
                return Ok(Raised::Feasible);
            }
            let negative = terms.iter().filter(|it| it.1 < 0);
            let entering =
                if wasted < PATIENCE { negative.min_by_key(|it| it.1) } else { negative.min() };
            let Some(&(column, number)) = entering else { return Ok(Raised::Maximal) };
            let mut leaving = feasible.then_some((row, right.checked_neg(), number.checked_neg()));
            for at_row in
                (0..self.rows.len()).filter(|&it| it != row && may_have(self.masks[it], column))
            {
                let (terms, right) = self.row(at_row);
                let number = at(terms, column);
                if number <= 0 || right < 0 {
                    continue;
                }
                let smaller = leaving.is_none_or(|(kept, kept_right, kept_number)| {
                    let (Some(kept_right), Some(kept_number)) = (kept_right, kept_number) else {
                        return false;
                    };
                    let [ours, theirs] = [(right, kept_number), (kept_right, number)]
                        .map(|(a, b)| i128::from(a) * i128::from(b));
                    ours < theirs
                        || ours == theirs && kept != row && self.before(at_row, kept, wasted)
                });
                if smaller {
                    leaving = Some((at_row, Some(right), Some(number)));
                }
            }
            let Some((leaving, limit, Some(_))) = leaving else { return Ok(Raised::Unbounded) };
            wasted = if limit == Some(0) { wasted + 1 } else { 0 };
            self.pivot(leaving, column, work)?;
        }
    }

    /// Which of two rows that limit a step equally should leave: the shorter one, or the one that
    /// cannot cycle.
    fn before(&self, one: usize, other: usize, wasted: u32) -> bool {
        let rank =
            |it: usize| (if wasted < PATIENCE { self.rows[it].len() } else { 0 }, self.basic[it]);
        rank(one) < rank(other)
    }

    fn pivot(&mut self, row: usize, column: u32, work: &mut Work) -> Result<(), Limit> {
        debug_assert!(at(&self.rows[row], column) != 0, "the variable is in the row");
        debug_assert_eq!((self.rows.len(), self.rows.len()), (self.basic.len(), self.masks.len()));
        if at(&self.rows[row], column) < 0 {
            let negated = self.rows[row]
                .iter()
                .map(|&(column, number)| Some((column, number.checked_neg()?)));
            self.rows[row] = Arc::new(negated.collect::<Option<_>>().ok_or(Limit::Tokens)?);
        }
        let pivot = Arc::clone(&self.rows[row]);
        let number = at(&pivot, column);
        work.spend(self.rows.len() / 4)?;
        let others = self.rows.iter_mut().zip(&mut self.masks).enumerate();
        for (_, (other, mask_of_other)) in
            others.filter(|it| it.0 != row && may_have(*it.1.1, column))
        {
            let theirs = at(other, column);
            if theirs != 0 {
                work.spend(other.len() + pivot.len())?;
                let (a, b) = cancelling(theirs, number).ok_or(Limit::Tokens)?;
                *other = Arc::new(combined(other, a, &pivot, b).ok_or(Limit::Tokens)?);
                *mask_of_other = mask(other);
            }
        }
        self.home[self.basic[row] as usize] = None;
        self.home[column as usize] = Some(row as u32);
        self.basic[row] = column;
        debug_assert!(at(&self.rows[row], column) > 0, "a basic variable has a positive number");
        Ok(())
    }
}

fn mask(row: &Row) -> u64 {
    row.iter().fold(0, |mask, it| mask | 1 << (it.0 % 64))
}

const fn may_have(mask: u64, column: u32) -> bool {
    mask >> (column % 64) & 1 == 1
}
