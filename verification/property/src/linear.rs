//! Sums of tokens, and comparing them.

use super::{Atom, Formula, Linear};
use cotama_core::net::PlaceId;
use std::collections::BTreeMap;

/// How two numbers are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    AtMost,
    Less,
    AtLeast,
    Greater,
    Equal,
    Unequal,
}

/// A sum while it is read; every operation is `None` beyond what can be counted with.
#[derive(Debug, Default)]
pub(super) struct Sum {
    constant: i128,
    weights: BTreeMap<PlaceId, i128>,
}

impl Sum {
    pub(super) fn constant(constant: i128) -> Self {
        Self { constant, weights: BTreeMap::new() }
    }

    pub(super) fn tokens(place: PlaceId) -> Self {
        Self { constant: 0, weights: BTreeMap::from([(place, 1)]) }
    }

    /// The place, if it is nothing but its tokens.
    pub(super) fn as_place(&self) -> Option<PlaceId> {
        let mut weights = self.weights.iter();
        match (self.constant, weights.next(), weights.next()) {
            (0, Some((&place, 1)), None) => Some(place),
            _ => None,
        }
    }

    /// This and so many times the other one.
    pub(super) fn plus(mut self, factor: i128, other: &Self) -> Option<Self> {
        self.constant = self.constant.checked_add(other.constant.checked_mul(factor)?)?;
        for (&place, weight) in &other.weights {
            let sum = self.weights.entry(place).or_insert(0);
            *sum = sum.checked_add(weight.checked_mul(factor)?)?;
        }
        Some(self)
    }

    /// The product; `Err` when neither is a number.
    pub(super) fn times(&self, other: &Self) -> Result<Option<Self>, ()> {
        match (self.weights.is_empty(), other.weights.is_empty()) {
            (true, _) => Ok(Self::default().plus(self.constant, other)),
            (_, true) => Ok(Self::default().plus(other.constant, self)),
            _ => Err(()),
        }
    }

    /// Returns the formula that compares the two.
    pub(super) fn compare(self, comparison: Comparison, other: &Self) -> Option<Formula> {
        let difference = self.plus(-1, other)?;
        let at_most = |factor: i128, more: i128| {
            let sum = Self::constant(more).plus(factor, &difference)?;
            let weight =
                |(&place, &weight): (&PlaceId, &i128)| Some((place, i64::try_from(weight).ok()?));
            let weights = sum.weights.iter().filter(|&(_, &weight)| weight != 0).map(weight);
            let linear = Linear {
                constant: sum.constant.try_into().ok()?,
                weights: weights.collect::<Option<_>>()?,
            };
            Some(Formula::Atom(Atom::AtMost(linear)))
        };
        let equal = || Some(Formula::And(vec![at_most(1, 0)?, at_most(-1, 0)?]));
        match comparison {
            Comparison::AtMost => at_most(1, 0),
            Comparison::Less => at_most(1, 1),
            Comparison::AtLeast => at_most(-1, 0),
            Comparison::Greater => at_most(-1, 1),
            Comparison::Equal => equal(),
            Comparison::Unequal => equal().map(|equal| Formula::Not(Box::new(equal))),
        }
    }
}

impl Linear {
    /// Returns the sum that is at most 0 exactly when a place is marked.
    pub fn marked(place: PlaceId) -> Self {
        Self { constant: 1, weights: vec![(place, -1)] }
    }

    /// Returns the inequality that the sum is at least so much; `None` when its numbers would be
    /// too large.
    pub fn at_least(&self, least: i64) -> Option<Self> {
        let weight = |&(place, weight): &(PlaceId, i64)| Some((place, weight.checked_neg()?));
        let weights = self.weights.iter().map(weight).collect::<Option<_>>()?;
        Some(Self { constant: least.checked_sub(self.constant)?, weights })
    }

    /// The inequality that holds exactly when this one does not; `None` when its numbers would be
    /// too large.
    pub fn negated(&self) -> Option<Self> {
        let weight = |&(place, weight): &(PlaceId, i64)| Some((place, weight.checked_neg()?));
        Some(Self {
            constant: 1_i64.checked_sub(self.constant)?,
            weights: self.weights.iter().map(weight).collect::<Option<_>>()?,
        })
    }
}

impl Formula {
    /// The most parts that the equivalences of one property may add.
    pub(super) const MAX_PARTS: usize = 1 << 20;

    /// Both or neither; `None` when that is too long to write. `budget` is how many parts may still
    /// be added.
    pub(super) fn equivalence(a: Self, b: Self, budget: &mut usize) -> Option<Self> {
        *budget = budget.checked_sub(a.length() + b.length())?;
        let neither =
            Self::And(vec![Self::Not(Box::new(a.clone())), Self::Not(Box::new(b.clone()))]);
        Some(Self::Or(vec![Self::And(vec![a, b]), neither]))
    }

    fn length(&self) -> usize {
        1 + self.parts().map(Self::length).sum::<usize>()
    }
}
