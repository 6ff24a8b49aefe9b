//! A formula about a marking, over packed markings.

use super::enabling::Seen;
use super::look::Look;
use super::space::Space;
use super::view::View;
use cotama_core::net::PlaceId;
use cotama_property::{Atom, Condition, Formula, Linear, Marking};
use std::sync::atomic::{AtomicI64, Ordering::Relaxed};

/// A formula that speaks of one marking only.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'f>(Asked<'f>);

/// The goal of a search, for one marking.
#[derive(Clone, Copy, Debug)]
enum Asked<'f> {
    Formula(&'f Formula),
    /// Nothing: the most that a sum ever is is kept.
    Most(&'f Linear, &'f AtomicI64),
}

impl<'f> Goal<'f> {
    /// Returns the goal; `None` when the formula has temporal operators.
    pub fn new(formula: &'f Formula) -> Option<Self> {
        formula.is_state().then_some(Self(Asked::Formula(formula)))
    }

    /// Returns a goal that no marking meets, and that records the largest value of a sum over the
    /// markings examined.
    pub(super) const fn most(sum: &'f Linear, most: &'f AtomicI64) -> Self {
        Self(Asked::Most(sum, most))
    }

    /// The formula; `None` of what asks for the most of a sum.
    pub(crate) fn formula(self) -> Option<&'f Formula> {
        match self.0 {
            Asked::Formula(formula) => Some(formula),
            Asked::Most(..) => None,
        }
    }

    /// Returns the goal compiled for markings of a space.
    pub(super) fn packed(self) -> Packed<'f> {
        match self.0 {
            Asked::Formula(formula) => match Condition::of_tokens(formula) {
                Some(condition) => Packed::Tokens(condition),
                None => Packed::Looks(self),
            },
            Asked::Most(sum, most) => Packed::Most(sum, most),
        }
    }
}

/// A goal for the markings of a space.
#[derive(Clone, Debug)]
pub(super) enum Packed<'f> {
    /// About tokens alone, of which it needs few.
    Tokens(Condition<'f>),
    /// About what is enabled, which is looked up for all transitions at once.
    Looks(Goal<'f>),
    /// The most that a sum ever is.
    Most(&'f Linear, &'f AtomicI64),
}

impl Packed<'_> {
    pub(super) fn holds(
        &self,
        space: &Space,
        packed: &[u64],
        view: &mut View,
        seen: &mut Seen,
    ) -> bool {
        match self {
            Self::Tokens(condition) => condition.holds(&Few { space, packed }),
            Self::Looks(goal) => {
                space.enabling.look(packed, view, seen);
                goal.holds(&Look::packed(space, packed, view))
            }
            Self::Most(sum, most) => keep(most, sum, &Few { space, packed }),
        }
    }
}

/// A marking of which only some places are asked: those that are implied are worked out one by one.
pub(super) struct Few<'m> {
    pub(super) space: &'m Space,
    pub(super) packed: &'m [u64],
}

impl Marking for Few<'_> {
    #[inline]
    fn tokens(&self, place: PlaceId) -> u64 {
        let layout = &self.space.layout;
        let Some(field) = layout.fields.get(place.0 as usize) else { return 0 };
        match self.packed.get(field.word) {
            Some(word) => field.tokens(*word),
            None => layout.computed_tokens(place.0, self.packed),
        }
    }
}

/// Keeps the most that a sum is.
fn keep(most: &AtomicI64, sum: &Linear, marking: &impl Marking) -> bool {
    let value = sum.value(marking).clamp(i64::MIN.into(), i64::MAX.into());
    most.fetch_max(value as i64, Relaxed);
    false
}

impl Goal<'_> {
    /// Whether it holds in a marking.
    pub(super) fn holds(self, look: &Look<'_>) -> bool {
        match self.0 {
            Asked::Formula(formula) => holds(formula, look),
            Asked::Most(sum, most) => keep(most, sum, look),
        }
    }
}

/// Whether a formula holds. What is enabled was looked up for all transitions at once, which no
/// [`Condition`](cotama_property::Condition) knows of.
fn holds(formula: &Formula, look: &Look<'_>) -> bool {
    match formula {
        Formula::Atom(Atom::AtMost(linear)) => linear.holds(look),
        Formula::Atom(Atom::Fireable(transitions)) => {
            transitions.iter().any(|it| look.enables(it.0))
        }
        Formula::Atom(Atom::Deadlock) => look.view.is_dead(),
        Formula::Not(inner) => !holds(inner, look),
        Formula::And(all) => all.iter().all(|it| holds(it, look)),
        Formula::Or(all) => all.iter().any(|it| holds(it, look)),
        // `Goal::new` lets no other formula pass.
        _ => false,
    }
}
