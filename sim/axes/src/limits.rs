//! Limits on sums at the end of a mission, as the monitor sees them.

use cotama_axes::{Kind, Mission, Relation};

/// An end constraint that can be monitored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Limit {
    /// The constraint, by index.
    pub(crate) constraint: usize,
    pub(crate) indicator: usize,
    /// The most that a sum may be, or the least.
    bound: Bound,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Bound {
    Most(i64),
    Least(i64),
}

impl Limit {
    /// Returns the end constraints of a mission in the order of treatment, or the one that asks for
    /// equality, which no run can keep.
    pub(crate) fn all(mission: &Mission) -> Result<Vec<Self>, usize> {
        let end = mission.constraints.iter().enumerate().filter(|it| it.1.kind == Kind::End);
        end.map(|(constraint, it)| {
            let bound = match it.relation {
                Relation::AtMost => Bound::Most(it.goal),
                Relation::Below => Bound::Most(it.goal.saturating_sub(1)),
                Relation::AtLeast => Bound::Least(it.goal),
                Relation::Above => Bound::Least(it.goal.saturating_add(1)),
                Relation::Equal => return Err(constraint),
            };
            Ok(Self { constraint, indicator: it.indicator, bound })
        })
        .collect()
    }

    /// Returns the margin of a final value (equation 7; the sign turned for an `at least`).
    pub(crate) const fn margin(&self, value: i64) -> i64 {
        match self.bound {
            Bound::Most(most) => most - value,
            Bound::Least(least) => value - least,
        }
    }

    /// Returns the most that a sum may be, where that is what is limited.
    pub(crate) const fn most(&self) -> Option<i64> {
        match self.bound {
            Bound::Most(most) => Some(most),
            Bound::Least(_) => None,
        }
    }
}
