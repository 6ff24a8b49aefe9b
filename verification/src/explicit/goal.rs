//! A formula about a marking, over packed markings.

use super::enabling::Seen;
use super::markings::Look;
use super::space::Space;
use super::view::View;
use crate::property::{Atom, Condition, Formula, Marking};
use cotama_core::net::PlaceId;

/// A formula that speaks of one marking only.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'f>(&'f Formula);

impl<'f> Goal<'f> {
    /// `None` when the formula has temporal operators.
    pub fn new(formula: &'f Formula) -> Option<Self> {
        formula.is_state().then_some(Self(formula))
    }

    /// The formula.
    pub fn formula(self) -> &'f Formula {
        self.0
    }

    /// What tells whether it holds in markings of a space.
    pub(super) fn packed(self) -> Packed<'f> {
        match Condition::of_tokens(self.0) {
            Some(condition) => Packed::Tokens(condition),
            None => Packed::Looks(self.0),
        }
    }
}

/// A goal for the markings of a space.
#[derive(Clone, Debug)]
pub(super) enum Packed<'f> {
    /// About tokens alone, of which it needs few.
    Tokens(Condition<'f>),
    /// About what is enabled, which is looked up for all transitions at once.
    Looks(&'f Formula),
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
            Self::Looks(formula) => {
                space.enabling.look(packed, view, seen);
                holds(formula, &Look { space, packed, view })
            }
        }
    }
}

/// A marking of which only some places are asked: those that are implied are worked out one by one.
struct Few<'m> {
    space: &'m Space,
    packed: &'m [u64],
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

/// Whether a formula holds. What is enabled was looked up for all transitions at once, which no
/// [`Condition`](crate::property::Condition) knows of.
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
