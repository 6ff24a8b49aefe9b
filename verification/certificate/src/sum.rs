//! Weighted sums of tokens, in exact numbers.

use super::verified::{Checked, error};
use std::collections::BTreeMap;

/// The tokens of each place. The first place is none of the net: it always holds one token, so that
/// its weight is a constant.
pub(super) type Marking = Vec<u32>;

/// The first place.
pub(super) const ONE: usize = 0;

/// Weights of places. Those that are read have 64 bits: with 32 bits for tokens, none of their
/// values passes 127.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Sum(pub(super) BTreeMap<usize, i128>);

impl Sum {
    pub(super) fn value(&self, marking: &Marking) -> i128 {
        self.0.iter().map(|(place, weight)| weight * i128::from(marking[*place])).sum()
    }

    /// The value for as many tokens as arcs take or give.
    pub(super) fn weigh(&self, arcs: &BTreeMap<usize, u32>) -> i128 {
        arcs.iter()
            .map(|(place, tokens)| self.0.get(place).unwrap_or(&0) * i128::from(*tokens))
            .sum()
    }

    /// Adds a multiple of another sum.
    pub(super) fn add(&mut self, factor: i128, other: &Self) -> Checked<()> {
        other.0.iter().try_for_each(|(place, weight)| {
            let before = self.0.entry(*place).or_default();
            let after = factor.checked_mul(*weight).and_then(|it| before.checked_add(it));
            after.map(|it| *before = it).ok_or_else(|| error("numbers get too large"))
        })
    }

    /// The sum that is at most 0 where this one is at least 1.
    pub(super) fn opposite(&self) -> Checked<Self> {
        let mut opposite = Self(BTreeMap::from([(ONE, 1)]));
        opposite.add(-1, self).map(|()| opposite)
    }
}
