//! Proofs from the structure of a net, written down so that anybody can check them again with
//! integers alone.
//!
//! Every proof has the same core, a [`Sum`]: inequalities that hold in a marking, each times a
//! factor of at least zero, add up to `something that is not negative + a positive number <= 0`. So
//! the marking does not exist. Around it stand case distinctions ([`Refutation`]) and a list of
//! transitions that can never fire ([`DeadTransitions`]), whose proof may lean on itself: the first
//! of them to fire would have fired in a marking that only the others have reached.

use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::Linear;
use cotama_property::pt::Pt;
use std::collections::BTreeMap;
use std::sync::Arc;

/// `sum of weight * tokens <= constant` in every reachable marking: it holds at the start, and no
/// transition that can fire increases the sum.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LinearInvariant {
    /// Weights of places, sorted by place, none of them zero.
    pub weights: Vec<(PlaceId, i128)>,
    /// Upper bound of the sum.
    pub constant: i128,
}

/// Places that are marked at the start and never lose their last token: a transition that takes
/// tokens from one of them leaves at least one token in one of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trap {
    /// The places, sorted.
    pub places: Vec<PlaceId>,
}

/// Inequalities, each of the form `constant + sum of weight * tokens <= 0`, that add up to a
/// contradiction: every weight of the sum is at least zero, and its constant is positive.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sum {
    /// Which assumptions take part, by position, and how often.
    pub premises: Vec<(usize, i128)>,
    /// Which traps take part, as `1 - tokens in the trap <= 0`, and how often.
    pub traps: Vec<(Trap, i128)>,
    /// Weighted sum that no transition changes for the worse; it takes part once. Bounds of many
    /// places share it.
    pub invariant: Arc<LinearInvariant>,
}

/// Why no reachable marking satisfies all of a list of assumptions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refutation {
    /// They add up to a contradiction.
    Sum(Sum),
    /// A place has either at most so many tokens or more; each case is refuted with `tokens <= at`
    /// or `tokens > at` as one more assumption.
    Tokens {
        /// The place.
        place: PlaceId,
        /// The number between the two cases.
        at: u32,
        /// Why there are not at most so many.
        below: Box<Self>,
        /// Why there are not more.
        above: Box<Self>,
    },
    /// In a dead marking some place holds fewer tokens than this transition needs; each of its
    /// needs, in the order of [`Pt::needs`], is refuted with `tokens < need` as one more
    /// assumption.
    Disabled {
        /// The transition.
        transition: TransitionId,
        /// One refutation for each need.
        cases: Vec<Self>,
    },
}

/// Transitions that never fire.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeadTransitions {
    /// All of them, sorted. One without a refutation needs more tokens of a place than this has at
    /// the start, and none but dead transitions add tokens to the place.
    pub transitions: Vec<TransitionId>,
    /// Why no reachable marking satisfies the needs of a transition; the assumptions are `tokens >=
    /// need`, in the order of [`Pt::needs`].
    pub refutations: Vec<(TransitionId, Refutation)>,
}

/// A weighted sum of tokens never exceeds a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// Weights of places.
    pub weights: Vec<(PlaceId, i64)>,
    /// The number.
    pub at_most: i64,
    /// Why the sum is never larger; the only assumption is `at_most + 1 - sum <= 0`.
    pub refutation: Refutation,
}

/// No reachable marking is dead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeadlockFree {
    /// Bounds of single places that `disabled` relies on.
    pub bounds: Vec<Bound>,
    /// The assumptions: for each of these transitions what [`disabled`] says of a marking in which
    /// it is not enabled.
    pub disabled: Vec<TransitionId>,
    /// Why they do not hold together.
    pub refutation: Refutation,
}

/// One inequality that holds, within bounds of places, exactly in the markings in which a
/// transition is not enabled; `None` when there is no such inequality or its numbers are too large.
///
/// Places that hold at most what is needed all hold exactly that when the transition is enabled. At
/// most one place may be able to hold more. `bound` is the most tokens that a place can hold.
pub fn disabled(
    pt: &Pt,
    transition: TransitionId,
    bound: impl Fn(PlaceId) -> Option<i64>,
) -> Option<Linear> {
    let needs = pt.needs.of(transition.0);
    if let &[(place, need)] = needs {
        return Some(Linear { constant: 1 - i64::from(need), weights: vec![(PlaceId(place), 1)] });
    }
    let mut spare = None;
    for &(place, need) in needs {
        if bound(PlaceId(place)).is_none_or(|it| it > i64::from(need))
            && spare.replace((place, need)).is_some()
        {
            return None;
        }
    }
    let factor = match spare {
        None => 1,
        Some((place, need)) => {
            bound(PlaceId(place))?.checked_sub(i64::from(need))?.checked_add(1)?
        }
    };
    let mut linear = Linear { constant: 1, weights: Vec::with_capacity(needs.len()) };
    for &(place, need) in needs {
        let weight = if spare.is_some_and(|it| it.0 == place) { 1 } else { factor };
        linear.weights.push((PlaceId(place), weight));
        linear.constant = linear.constant.checked_sub(weight.checked_mul(i64::from(need))?)?;
    }
    Some(linear)
}

/// Returns whether an inequality holds at the start.
fn starts_with(pt: &Pt, linear: &Linear) -> bool {
    let tokens =
        linear.weights.iter().map(|&(place, weight)| initial(pt, place).checked_mul(weight.into()));
    sum(tokens).and_then(|it| it.checked_add(linear.constant.into())).is_some_and(|it| it <= 0)
}

fn initial(pt: &Pt, place: PlaceId) -> i128 {
    pt.initial.get(place.0 as usize).map_or(0, |&it| it.into())
}

fn sum(mut numbers: impl Iterator<Item = Option<i128>>) -> Option<i128> {
    numbers.try_fold(0_i128, |sum, it| sum.checked_add(it?))
}

impl LinearInvariant {
    /// Whether it is one, when only these transitions can fire.
    pub fn holds(&self, pt: &Pt, can_fire: impl Fn(TransitionId) -> bool) -> bool {
        let weights: BTreeMap<u32, i128> =
            self.weights.iter().map(|&(place, weight)| (place.0, weight)).collect();
        let start =
            sum(weights.iter().map(|(&place, it)| it.checked_mul(initial(pt, PlaceId(place)))));
        weights.len() == self.weights.len()
            && start.is_some_and(|it| it <= self.constant)
            && (0..pt.transitions.len() as u32).filter(|&it| can_fire(TransitionId(it))).all(
                |transition| {
                    let change = pt.effects.of(transition).iter().filter_map(|&(place, by)| {
                        weights.get(&place).map(|weight| weight.checked_mul(by.into()))
                    });
                    sum(change).is_some_and(|it| it <= 0)
                },
            )
    }
}

impl Trap {
    /// Whether it is one, when only these transitions can fire, and marked at the start.
    pub fn holds(&self, pt: &Pt, can_fire: impl Fn(TransitionId) -> bool) -> bool {
        let within = |place: u32| self.places.contains(&PlaceId(place));
        self.places.iter().any(|&it| initial(pt, it) > 0)
            && (0..pt.transitions.len() as u32).filter(|&it| can_fire(TransitionId(it))).all(
                |transition| {
                    let effects = pt.effects.of(transition);
                    let change =
                        |place| effects.iter().find(|it| it.0 == place).map_or(0, |it| it.1);
                    let needs = pt.needs.of(transition);
                    effects.iter().all(|&(place, by)| by > 0 || !within(place))
                        || effects.iter().any(|&(place, by)| by > 0 && within(place))
                        || needs.iter().any(|&(place, need)| {
                            within(place) && i64::from(need) + change(place) > 0
                        })
                },
            )
    }
}

impl Sum {
    fn refutes(
        &self,
        pt: &Pt,
        can_fire: &impl Fn(TransitionId) -> bool,
        premises: &[Linear],
    ) -> bool {
        let add = || {
            let mut constant = self.invariant.constant.checked_neg()?;
            let mut weights: BTreeMap<PlaceId, i128> =
                self.invariant.weights.iter().copied().collect();
            let mut term = |place, weight: i128, factor: i128| {
                let sum = weights.entry(place).or_insert(0);
                *sum = sum.checked_add(weight.checked_mul(factor)?)?;
                Some(())
            };
            for &(at, factor) in &self.premises {
                let premise = premises.get(at)?;
                constant = constant.checked_add(factor.checked_mul(premise.constant.into())?)?;
                for &(place, weight) in &premise.weights {
                    term(place, weight.into(), factor)?;
                }
            }
            for (trap, factor) in &self.traps {
                constant = constant.checked_add(*factor)?;
                for &place in &trap.places {
                    term(place, -1, *factor)?;
                }
            }
            Some(constant > 0 && weights.values().all(|&it| it >= 0))
        };
        self.premises.iter().all(|it| it.1 >= 0)
            && self.traps.iter().all(|(trap, factor)| *factor >= 0 && trap.holds(pt, can_fire))
            && self.invariant.holds(pt, can_fire)
            && add() == Some(true)
    }
}

impl Refutation {
    /// Whether it refutes these assumptions, when only these transitions can fire; `dead` when one
    /// of the assumptions is that the marking is dead.
    pub fn refutes(
        &self,
        pt: &Pt,
        can_fire: &impl Fn(TransitionId) -> bool,
        premises: &mut Vec<Linear>,
        dead: bool,
    ) -> bool {
        let mut case = |refutation: &Self, premise| {
            premises.push(premise);
            let refuted = refutation.refutes(pt, can_fire, premises, dead);
            premises.pop();
            refuted
        };
        match self {
            Self::Sum(sum) => sum.refutes(pt, can_fire, premises),
            Self::Tokens { place, at, below, above } => {
                case(below, at_most(*place, *at))
                    && case(above, at_least(*place, i64::from(*at) + 1))
            }
            Self::Disabled { transition, cases } => {
                let needs = pt.needs.of(transition.0);
                dead && (transition.0 as usize) < pt.transitions.len()
                    && cases.len() == needs.len()
                    && needs
                        .iter()
                        .zip(cases)
                        .all(|(&(place, need), it)| case(it, fewer(place, need)))
            }
        }
    }
}

/// `tokens <= at`
pub fn at_most(place: PlaceId, at: u32) -> Linear {
    Linear { constant: -i64::from(at), weights: vec![(place, 1)] }
}

/// `tokens >= least`
pub fn at_least(place: PlaceId, least: i64) -> Linear {
    Linear { constant: least, weights: vec![(place, -1)] }
}

/// `tokens < need`
pub fn fewer(place: u32, need: u32) -> Linear {
    Linear { constant: 1 - i64::from(need), weights: vec![(PlaceId(place), 1)] }
}

/// `tokens >= need` for all needs of a transition.
pub fn needs(pt: &Pt, transition: TransitionId) -> Vec<Linear> {
    pt.needs
        .of(transition.0)
        .iter()
        .map(|&(place, need)| at_least(PlaceId(place), need.into()))
        .collect()
}

impl DeadTransitions {
    /// Whether a transition is not one of them.
    pub fn can_fire(&self, transition: TransitionId) -> bool {
        self.transitions.binary_search(&transition).is_err()
    }

    /// Whether none of them can ever fire.
    pub fn holds(&self, pt: &Pt) -> bool {
        let can_fire = |it| self.can_fire(it);
        let full = |place| {
            pt.changers
                .of(place)
                .iter()
                .all(|&(transition, by)| by < 0 || !can_fire(TransitionId(transition)))
        };
        self.transitions.is_sorted()
            && self.transitions.iter().all(|&dead| {
                match self.refutations.iter().find(|it| it.0 == dead) {
                    Some((_, it)) => it.refutes(pt, &can_fire, &mut needs(pt, dead), false),
                    None => pt.needs.of(dead.0).iter().any(|&(place, need)| {
                        initial(pt, PlaceId(place)) < need.into() && full(place)
                    }),
                }
            })
    }
}

impl Bound {
    /// Whether it is one, when these transitions never fire.
    pub fn holds(&self, pt: &Pt, dead: &DeadTransitions) -> bool {
        let Some(premise) = above(&self.weights, self.at_most) else { return false };
        dead.holds(pt)
            && self.refutation.refutes(pt, &|it| dead.can_fire(it), &mut vec![premise], false)
    }
}

/// `sum > at_most`
pub fn above(weights: &[(PlaceId, i64)], at_most: i64) -> Option<Linear> {
    let weight = |&(place, weight): &(PlaceId, i64)| Some((place, weight.checked_neg()?));
    let weights = weights.iter().map(weight).collect::<Option<_>>()?;
    Some(Linear { constant: at_most.checked_add(1)?, weights })
}

impl DeadlockFree {
    /// Whether it shows that no reachable marking is dead, when these transitions never fire.
    pub fn holds(&self, pt: &Pt, dead: &DeadTransitions) -> bool {
        let bound = |place| {
            let of_place = |it: &&Bound| it.weights == [(place, 1)];
            self.bounds.iter().find(of_place).map(|it| it.at_most)
        };
        let premises =
            self.disabled.iter().map(|&it| disabled(pt, it, bound)).collect::<Option<Vec<_>>>();
        self.bounds.iter().all(|it| it.holds(pt, dead))
            && dead.holds(pt)
            && premises.is_some_and(|mut it| {
                self.refutation.refutes(pt, &|it| dead.can_fire(it), &mut it, true)
            })
    }
}

/// Whether no reachable marking satisfies all of these inequalities, by this refutation, when these
/// transitions never fire.
pub fn unreachable(
    pt: &Pt,
    dead: &DeadTransitions,
    goal: &[Linear],
    refutation: &Refutation,
) -> bool {
    dead.holds(pt) && refutation.refutes(pt, &|it| dead.can_fire(it), &mut goal.to_vec(), false)
}

/// Whether all inequalities of a goal hold at the start.
pub fn holds_at_start(pt: &Pt, goal: &[Linear]) -> bool {
    goal.iter().all(|it| starts_with(pt, it))
}
