//! A formula about a marking, over packed markings.

use super::enabling::Seen;
use super::markings::Look;
use super::space::Space;
use super::view::View;
use crate::property::{Atom, Formula};

/// A formula that speaks of one marking only.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'f>(&'f Formula);

impl<'f> Goal<'f> {
    /// `None` when the formula has temporal operators.
    pub fn new(formula: &'f Formula) -> Option<Self> {
        formula.is_state().then_some(Self(formula))
    }

    /// What tells whether it holds in markings of a space.
    pub(super) fn packed(self, space: &Space) -> Packed<'f> {
        let asks = |it: &Formula| matches!(it, Formula::Atom(Atom::Fireable(_) | Atom::Deadlock));
        Packed { formula: self.0, looks: self.0.any(&asks) || space.layout.computed > 0 }
    }
}

/// A goal for the markings of a space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packed<'f> {
    formula: &'f Formula,
    /// Whether it depends on more than stored words.
    looks: bool,
}

impl Packed<'_> {
    pub(super) fn holds(
        self,
        space: &Space,
        packed: &[u64],
        view: &mut View,
        seen: &mut Seen,
    ) -> bool {
        if self.looks {
            space.enabling.look(packed, view, seen);
        }
        holds(self.formula, &Look { space, packed, view })
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
