//! Which capabilities something needs.

use super::capability::{Capability, CapabilitySet, Robot};
use super::ratio::Ratio;
use super::reliability::Probability;

/// Which capabilities something needs (def. 3.8 to 3.10). It is monotone by its form: more
/// capabilities never break it.
///
/// ```
/// use cotama_models::team::{CapabilitySet, Constraint, service::{GRASP_2F, GRASP_3F, MOVE}};
/// let fetch = Constraint::All(&[
///     Constraint::Has(MOVE),
///     Constraint::Any(&[Constraint::Has(GRASP_2F), Constraint::Has(GRASP_3F)]),
/// ]);
/// assert!(fetch.holds(CapabilitySet::of(&[MOVE, GRASP_3F])));
/// assert!(!fetch.holds(CapabilitySet::of(&[GRASP_2F, GRASP_3F])));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constraint<'a> {
    /// This capability.
    Has(Capability),
    /// All of these; nothing, if there are none.
    All(&'a [Self]),
    /// Any of these; what nobody can, if there are none.
    Any(&'a [Self]),
}

/// How a robot meets a constraint, and how likely that succeeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Used {
    /// Cost of the capabilities used, beside that of the action.
    pub surcharge: u64,
    /// Probability that none of them fails (3.11, 3.12).
    pub success: Probability,
}

impl Constraint<'_> {
    /// Nothing is needed.
    pub const NOTHING: Constraint<'static> = Constraint::All(&[]);

    /// Whether these capabilities are enough (def. 3.9, 3.10).
    pub fn holds(&self, set: CapabilitySet) -> bool {
        match self {
            Self::Has(capability) => set.has(*capability),
            Self::All(parts) => parts.iter().all(|it| it.holds(set)),
            Self::Any(parts) => parts.iter().any(|it| it.holds(set)),
        }
    }

    /// How a robot meets it; none where it cannot. Of "all of", each must succeed (3.11). Of "any
    /// of", the robot uses what costs least: the surcharge, and what a failure would cost times its
    /// probability (3.12); of equal ones the first.
    ///
    /// `surcharge` is what an action costs more if it uses a capability; `failure` is
    /// [`failure_cost`](super::failure_cost).
    pub fn used(
        &self,
        robot: &Robot<'_>,
        surcharge: &dyn Fn(Capability) -> u64,
        failure: Ratio,
    ) -> Option<Used> {
        match self {
            Self::Has(capability) => Some(Used {
                surcharge: surcharge(*capability),
                success: robot.reliability(*capability)?,
            }),
            Self::All(parts) => {
                let none = Used { surcharge: 0, success: Probability::ONE };
                parts.iter().try_fold(none, |all, it| {
                    let it = it.used(robot, surcharge, failure)?;
                    Some(Used {
                        surcharge: all.surcharge.saturating_add(it.surcharge),
                        success: all.success.and(it.success),
                    })
                })
            }
            Self::Any(parts) => {
                let ways = parts.iter().filter_map(|it| it.used(robot, surcharge, failure));
                ways.min_by_key(|it| it.weighed(failure))
            }
        }
    }

    /// The smallest sets of capabilities that meet it; none where these are more than `N`.
    pub fn alternatives<const N: usize>(&self) -> Option<Alternatives<N>> {
        match self {
            Self::Has(capability) => {
                let mut all = Alternatives::NONE;
                all.add(CapabilitySet::of(&[*capability]))?;
                Some(all)
            }
            Self::Any(parts) => {
                let mut all = Alternatives::NONE;
                for part in *parts {
                    all = all.either(&part.alternatives()?)?;
                }
                Some(all)
            }
            Self::All(parts) => {
                let mut all = Alternatives::NONE;
                all.add(CapabilitySet::NONE)?;
                for part in *parts {
                    all = all.both(&part.alternatives()?)?;
                }
                Some(all)
            }
        }
    }
}

impl Used {
    /// Surcharge and failure cost times probability of failure, in parts of a common denominator.
    fn weighed(&self, failure: Ratio) -> u128 {
        let parts = u128::from(Probability::PARTS).saturating_mul(failure.denominator());
        let risk = failure.numerator().saturating_mul(self.success.failing().into());
        parts.saturating_mul(self.surcharge.into()).saturating_add(risk)
    }
}

/// Sets of capabilities, each of which is enough, and none of which has another in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Alternatives<const N: usize> {
    sets: [u64; N],
    len: usize,
}

impl<const N: usize> Alternatives<N> {
    /// Nothing is enough.
    pub(super) const NONE: Self = Self { sets: [0; N], len: 0 };

    /// The sets, one bit a capability.
    pub fn bits(&self) -> &[u64] {
        self.sets.get(..self.len).unwrap_or(&[])
    }

    /// The sets.
    pub fn iter(&self) -> impl Iterator<Item = CapabilitySet> + '_ {
        self.bits().iter().map(|it| CapabilitySet::from_bits(*it as u32))
    }

    /// Returns the disjunction: the sets of both constraints.
    pub(super) fn either(&self, other: &Self) -> Option<Self> {
        let mut all = *self;
        other.iter().try_for_each(|set| all.add(set))?;
        Some(all)
    }

    /// Returns the conjunction: each union of two sets, one of either constraint.
    pub(super) fn both(&self, other: &Self) -> Option<Self> {
        let mut all = Self::NONE;
        for one in self.iter() {
            other.iter().try_for_each(|set| all.add(one.and(set)))?;
        }
        Some(all)
    }

    /// One more set, unless another suffices; without those that it makes needless.
    fn add(&mut self, set: CapabilitySet) -> Option<()> {
        let set = u64::from(set.bits());
        if self.bits().iter().any(|it| it & !set == 0) {
            return Some(());
        }
        let (mut kept, before) = (Self::NONE, *self);
        for it in before.bits().iter().chain([&set]).filter(|it| **it == set || set & !**it != 0) {
            *kept.sets.get_mut(kept.len)? = *it;
            kept.len = kept.len.saturating_add(1);
        }
        *self = kept;
        Some(())
    }
}
