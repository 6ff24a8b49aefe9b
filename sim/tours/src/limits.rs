//! Limits on sums at the end of a mission, as the monitor sees them.

use cotama_axes::{Kind, Mission, Relation};

/// An end constraint that can be monitored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Limit {
    /// The constraint, by index.
    pub(crate) constraint: usize,
    pub(crate) indicator: usize,
    relation: Relation,
    goal: i64,
}

impl Limit {
    /// Returns the end constraints of a mission in the order of treatment, or the one that asks for
    /// equality, which no run can keep.
    pub(crate) fn all(mission: &Mission) -> Result<Vec<Self>, usize> {
        let end = mission.constraints.iter().enumerate().filter(|it| it.1.kind == Kind::End);
        end.map(|(constraint, it)| match it.relation {
            Relation::Equal => Err(constraint),
            relation => Ok(Self { constraint, indicator: it.indicator, relation, goal: it.goal }),
        })
        .collect()
    }

    /// Returns the margin of a final value (equation 7; the sign turned for an `at least`).
    pub(crate) const fn margin(&self, value: i64) -> i64 {
        self.relation.margin(value, self.goal)
    }

    /// Returns the most that a sum may be, where that is what is limited.
    pub(crate) const fn most(&self) -> Option<i64> {
        match self.relation {
            Relation::AtMost => Some(self.goal),
            Relation::Below => Some(self.goal - 1),
            Relation::Equal | Relation::AtLeast | Relation::Above => None,
        }
    }
}
