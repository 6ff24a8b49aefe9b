//! Posteriors of a Bayesian network on a robot: integers only, no heap, an order of elimination
//! that was fixed beforehand, and a bound of the error with every answer.
//!
//! A [`Query`] is made on a workstation, by `cotama risk table`, and printed as constants. Tables
//! hold probabilities in units of 2⁻³⁰, each row with a sum of exactly 2³⁰ (largest remainders).
//! Products are computed in units of 2⁻⁶⁰ and cut off, so that no result is too large: summed over
//! the variables eliminated so far it is a sum of probabilities of events that exclude one another,
//! at most 1.
//!
//! # The error
//!
//! Let S be the probability of the evidence as computed, in units of 2⁻⁶⁰, and r the states of the
//! query. Two things are lost.
//!
//! *Cut off products.* A product of k factors loses less than the sum of what its factors lost and
//! k - 1 units more; a step that sums s products loses s times that. Both follow from the steps
//! alone: [`Query::cut_off`] is the loss C of one state of the query.
//!
//! *Rounded tables.* Two networks whose rows differ by at most d (the sum of absolute differences,
//! per variable the largest) give any event probabilities that differ by at most the sum D of all
//! d: one variable after the other is exchanged, and each exchange moves at most its d.
//!
//! A state with the exact probability n of N, computed as m of S, has |n - m| ≤ C + D and |N - S| ≤
//! r C + D, so that |n/N - m/S| ≤ |n - m|/S + (n/N) |N - S|/S ≤ ((r + 1) C + 2 D)/S. The answer
//! adds a unit of 2⁻³⁰ for the last division, and one to round the bound up. Where the bound passes
//! 1, nothing is known, and the answer is an error.
#![no_std]

/// One, in the units of tables and answers.
pub const ONE: u32 = 1 << 30;

/// The most variables of the result of a step.
pub const MAX_RANK: usize = 8;

/// A table that a step multiplies, and how its cells are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operand<'a> {
    /// Whether it is the result of an earlier step, and no table of the network.
    pub is_result: bool,
    /// Place of its first cell, among tables or among results.
    pub at: u32,
    /// For each variable of the step's result the distance of its states.
    pub strides: &'a [u32],
    /// The distance of the states of the variable that is summed out.
    pub inner: u32,
    /// Evidence by its number, and the distance of its states.
    pub fixed: &'a [(u8, u32)],
}

/// Tables multiplied, and a variable summed out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step<'a> {
    /// Factors of the product.
    pub operands: &'a [Operand<'a>],
    /// States of the variables of the result, the last fastest; at most [`MAX_RANK`].
    pub shape: &'a [u16],
    /// States of the variable that is summed out; 1 where none is.
    pub summed: u16,
    /// Place of the first cell of its result.
    pub to: u32,
}

/// A query prepared for any states of its evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Query<'a> {
    /// Probabilities in units of 2⁻³⁰.
    pub tables: &'a [u32],
    /// In the order in which they are done; the last one leaves the query.
    pub steps: &'a [Step<'a>],
    /// States of each variable that is evidence.
    pub evidence: &'a [u16],
    /// Cells of all results together: so much memory an answer needs.
    pub scratch: usize,
    /// The error D of the tables, in units of 2⁻⁶⁰.
    pub rounded: u64,
}

/// Reasons for which there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoAnswer {
    /// The evidence has probability 0, or one so small that nothing is known of the answer.
    Impossible,
    /// There are not as many states as evidence, one is none, or the memory is too small.
    Malformed,
}

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// The probability of the evidence in units of 2⁻⁶⁰, cut off.
    pub evidence: u64,
    /// No probability is further from the exact one than this, in units of 2⁻³⁰.
    pub error: u32,
}

impl Query<'_> {
    /// Number of states of the query.
    pub fn states(&self) -> usize {
        let last = self.steps.last().map_or(&[][..], |it| it.shape);
        cells(last)
    }

    /// The loss C of one state of the query by products that are cut off, in units of 2⁻⁶⁰.
    pub fn cut_off(&self) -> u64 {
        self.steps.last().map_or(0, |it| self.lost(it, self.steps.len()))
    }

    /// Loss of a cell of the result of a step; a result is of one of the first `before` steps.
    fn lost(&self, step: &Step<'_>, before: usize) -> u64 {
        let one = |operand: &Operand<'_>| {
            if !operand.is_result {
                return 0;
            }
            let earlier = self.steps.get(..before).unwrap_or(&[]);
            let found = earlier.iter().rposition(|it| it.to == operand.at);
            let found = found.and_then(|at| Some((at, earlier.get(at)?)));
            found.map_or(0, |(at, it)| self.lost(it, at))
        };
        let all = step.operands.iter().map(one).fold(0, u64::saturating_add);
        let own = step.operands.len().saturating_sub(1) as u64;
        all.saturating_add(own).saturating_mul(u64::from(step.summed))
    }

    /// Answers for these states of the evidence: fills `posterior` with probabilities in units of
    /// 2⁻³⁰, one for each state of the query.
    ///
    /// # Errors
    /// [`NoAnswer`]; `scratch` holds at least [`Query::scratch`] cells, `posterior` at least
    /// [`Query::states`].
    pub fn answer(
        &self,
        evidence: &[u8],
        scratch: &mut [u64],
        posterior: &mut [u32],
    ) -> Result<Answer, NoAnswer> {
        let is_state = |it: (&u8, &u16)| u16::from(*it.0) < *it.1;
        let fits = evidence.len() == self.evidence.len()
            && evidence.iter().zip(self.evidence).all(is_state)
            && scratch.len() >= self.scratch
            && posterior.len() >= self.states();
        if !fits {
            return Err(NoAnswer::Malformed);
        }
        for step in self.steps {
            self.run(step, evidence, scratch).ok_or(NoAnswer::Malformed)?;
        }
        let last = self.steps.last().ok_or(NoAnswer::Malformed)?;
        let from = last.to as usize;
        let end = from.saturating_add(self.states());
        let result = scratch.get(from..end).ok_or(NoAnswer::Malformed)?;
        let sum = result.iter().fold(0_u64, |all, it| all.saturating_add(*it));
        let lost = u128::from(self.cut_off()).saturating_mul(result.len() as u128 + 1);
        let wrong = lost.saturating_add(2 * u128::from(self.rounded));
        if sum == 0 || wrong > u128::from(sum) {
            return Err(NoAnswer::Impossible);
        }
        for (to, cell) in posterior.iter_mut().zip(result) {
            *to = over(u128::from(*cell), sum);
        }
        // Rounded up, and one unit for the division.
        let error = over(wrong, sum).saturating_add(2);
        Ok(Answer { evidence: sum, error })
    }

    /// Does a step; none where it reaches beyond its tables.
    fn run(&self, step: &Step<'_>, evidence: &[u8], scratch: &mut [u64]) -> Option<()> {
        let rank = step.shape.len();
        let mut digits = [0_u16; MAX_RANK];
        let digits = digits.get_mut(..rank)?;
        let size = cells(step.shape);
        let to = step.to as usize;
        for cell in 0..size {
            let mut sum = 0_u64;
            for state in 0..u32::from(step.summed) {
                let mut product = 1_u64 << 60;
                for operand in step.operands {
                    let at = operand.place(evidence, digits, state)?;
                    product = if operand.is_result {
                        times(product, *scratch.get(at)?, 60)
                    } else {
                        times(product, u64::from(*self.tables.get(at)?), 30)
                    };
                }
                sum = sum.saturating_add(product);
            }
            *scratch.get_mut(to.saturating_add(cell))? = sum;
            for (digit, states) in digits.iter_mut().zip(step.shape).rev() {
                *digit = digit.saturating_add(1);
                if *digit < *states {
                    break;
                }
                *digit = 0;
            }
        }
        Some(())
    }
}

impl Operand<'_> {
    /// The place of a cell; none where the evidence has no such number.
    fn place(&self, evidence: &[u8], digits: &[u16], state: u32) -> Option<usize> {
        let mut at = self.at.saturating_add(self.inner.saturating_mul(state));
        for (number, far) in self.fixed {
            let state = u32::from(*evidence.get(usize::from(*number))?);
            at = at.saturating_add(state.saturating_mul(*far));
        }
        for (digit, far) in digits.iter().zip(self.strides) {
            at = at.saturating_add(u32::from(*digit).saturating_mul(*far));
        }
        Some(at as usize)
    }
}

/// Number of cells of a shape.
fn cells(shape: &[u16]) -> usize {
    shape.iter().fold(1, |all: usize, it| all.saturating_mul(usize::from(*it)))
}

/// A share of a sum, which is not zero, in units of 2⁻³⁰.
fn over(part: u128, sum: u64) -> u32 {
    (part << 30).checked_div(u128::from(sum)).unwrap_or(0) as u32
}

/// A product, cut off: of a number of units of 2⁻⁶⁰ and one of units of 2⁻ᵇ.
const fn times(one: u64, two: u64, bits: u32) -> u64 {
    ((one as u128 * two as u128) >> bits) as u64
}

#[cfg(test)]
mod tests {
    use super::{Answer, NoAnswer, ONE, Operand, Query, Step};

    const QUARTER: u32 = ONE / 4;

    /// P(open) = 1/4; P(seen | open) = 3/4, P(seen | closed) = 1/4; asked is `open` given `seen`.
    const DOOR: Query<'_> = Query {
        tables: &[QUARTER, 3 * QUARTER, 3 * QUARTER, QUARTER, QUARTER, 3 * QUARTER],
        steps: &[Step {
            operands: &[
                Operand { is_result: false, at: 0, strides: &[1], inner: 0, fixed: &[] },
                Operand { is_result: false, at: 2, strides: &[2], inner: 0, fixed: &[(0, 1)] },
            ],
            shape: &[2],
            summed: 1,
            to: 0,
        }],
        evidence: &[2],
        scratch: 2,
        rounded: 0,
    };

    #[test]
    fn a_seen_door_is_open_with_one_half() {
        let (mut scratch, mut posterior) = ([0; 2], [0; 2]);
        let answer = DOOR.answer(&[0], &mut scratch, &mut posterior);
        // 3/16 open, 3/16 closed; the products lose nothing, and the bound need not know.
        assert_eq!(answer, Ok(Answer { evidence: 6 << 56, error: 2 }));
        assert_eq!(posterior, [ONE / 2; 2]);
        let other = DOOR.answer(&[1], &mut scratch, &mut posterior);
        assert_eq!(other.map(|it| it.evidence), Ok(10 << 56));
        assert_eq!(posterior, [ONE / 10, (u64::from(ONE) * 9 / 10) as u32]);
    }

    #[test]
    fn a_query_that_does_not_fit_is_an_error_value() {
        let (mut scratch, mut posterior) = ([0; 2], [0; 2]);
        for evidence in [&[][..], &[2], &[0, 0]] {
            let answer = DOOR.answer(evidence, &mut scratch, &mut posterior);
            assert_eq!(answer, Err(NoAnswer::Malformed));
        }
        assert_eq!(DOOR.answer(&[0], &mut [0], &mut posterior), Err(NoAnswer::Malformed));
        let certain = Query { tables: &[ONE, 0, 0, ONE, ONE, 0], ..DOOR };
        let answer = certain.answer(&[0], &mut scratch, &mut posterior);
        assert_eq!(answer, Err(NoAnswer::Impossible));
    }
}
