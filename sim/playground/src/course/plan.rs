//! A plan of faults, as a page writes it: numbers of 32 bits.

use super::Moment;
use alloc::vec::Vec;
use cotama_core::units::Millis;

/// The most faults, and the most answers of the operator.
const MOST: usize = 256;

/// Something that fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The row of the FMECA, by its number.
    pub row: usize,
    /// True if it is told when it begins, as a planner does that finds no plan: no flag shows it.
    pub is_told: bool,
    /// When it begins.
    pub when: Moment,
    /// When it ends, if not by itself.
    pub until: Option<Moment>,
}

/// The answers of the operator to the first request from a place on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answers {
    /// The place, in mm.
    pub x: u64,
    /// Before each answer.
    pub delay: Millis,
    /// 0 that he is done, 1 that he gives up, else the sub-objective that he chooses, after 2.
    pub answers: Vec<u32>,
}

/// Faults, and answers of the operator.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// The faults.
    pub faults: Vec<Fault>,
    /// The answers, in the order of places.
    pub answers: Vec<Answers>,
}

impl Plan {
    /// Reads a plan: how many faults, each as its row, 1 if it is told, its moment, and its end;
    /// how many requests, each as place, delay, the number of answers, and these. A moment is its
    /// kind and two numbers: 0 a place, 1 a time, 2 a sub-objective and a time, 3 a time of
    /// waiting, 4 none.
    pub fn of_numbers(numbers: &[u32]) -> Option<Self> {
        let from = &mut numbers.iter().copied();
        let mut plan = Self::default();
        for _ in 0..count(from)? {
            let (row, is_told) = (from.next()? as usize, from.next()? == 1);
            let when = moment(from)?.ok()?;
            let until = moment(from)?.ok();
            plan.faults.push(Fault { row, is_told, when, until });
        }
        for _ in 0..count(from)? {
            let (x, delay) = (u64::from(from.next()?), Millis(u64::from(from.next()?)));
            let answers = (0..count(from)?).map(|_| from.next()).collect::<Option<_>>()?;
            plan.answers.push(Answers { x, delay, answers });
        }
        from.next().is_none().then_some(plan)
    }

    /// Writes a plan so.
    pub fn to_numbers(&self) -> Vec<u32> {
        let mut out = Vec::from([self.faults.len() as u32]);
        for it in &self.faults {
            out.extend([it.row as u32, u32::from(it.is_told)]);
            out.extend(numbers(Some(it.when)));
            out.extend(numbers(it.until));
        }
        out.push(self.answers.len() as u32);
        for it in &self.answers {
            out.extend([it.x as u32, it.delay.0 as u32, it.answers.len() as u32]);
            out.extend(&it.answers);
        }
        out
    }
}

fn count(from: &mut impl Iterator<Item = u32>) -> Option<usize> {
    from.next().map(|it| it as usize).filter(|it| *it <= MOST)
}

/// The kind of none.
struct Never;

/// A moment, or [`Never`].
fn moment(from: &mut impl Iterator<Item = u32>) -> Option<Result<Moment, Never>> {
    let (kind, first) = (from.next()?, from.next()?);
    let time = Millis(u64::from(from.next()?));
    Some(match kind {
        0 => Ok(Moment::Place(u64::from(first))),
        1 => Ok(Moment::At(time)),
        2 => Ok(Moment::During(first as usize, time)),
        3 => Ok(Moment::Waiting(time)),
        4 => Err(Never),
        _ => return None,
    })
}

/// Returns a moment, or none, as numbers.
pub fn numbers(it: Option<Moment>) -> [u32; 3] {
    match it {
        Some(Moment::Place(x)) => [0, x as u32, 0],
        Some(Moment::At(at)) => [1, 0, at.0 as u32],
        Some(Moment::During(place, after)) => [2, place as u32, after.0 as u32],
        Some(Moment::Waiting(after)) => [3, 0, after.0 as u32],
        None => [4, 0, 0],
    }
}

#[cfg(test)]
mod tests {
    use super::{Answers, Fault, Moment, Plan};
    use cotama_core::units::Millis;
    use std::vec;

    #[test]
    fn a_plan_is_read_as_it_was_written_and_no_part_of_it() {
        let (when, until) = (Moment::During(2, Millis(50)), Some(Moment::Waiting(Millis(7))));
        let plan = Plan {
            faults: vec![
                Fault { row: 3, is_told: true, when, until },
                Fault { row: 4, is_told: false, when: Moment::Place(9), until: None },
                Fault {
                    row: 5,
                    is_told: false,
                    when: Moment::At(Millis(11)),
                    until: Some(Moment::At(Millis(12))),
                },
            ],
            answers: vec![Answers { x: 1, delay: Millis(2), answers: vec![4, 0] }],
        };
        let numbers = plan.to_numbers();
        assert_eq!(Plan::of_numbers(&numbers), Some(plan));
        for end in 0..numbers.len() {
            assert_eq!(Plan::of_numbers(&numbers[..end]), None, "{end}");
        }
        assert_eq!(Plan::of_numbers(&[u32::MAX, 0]), None);
    }
}
