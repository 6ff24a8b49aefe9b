//! A formula about a marking, over packed markings.

use super::enabling::Seen;
use super::markings::Look;
use super::space::Space;
use super::view::View;
use crate::property::{Atom, Formula, Linear};
use std::sync::atomic::{AtomicI64, Ordering::Relaxed};

/// A formula that speaks of one marking only.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'f>(Asked<'f>);

/// What is asked of a marking.
#[derive(Clone, Copy, Debug)]
enum Asked<'f> {
    Formula(&'f Formula),
    /// Nothing: the most that a sum ever is is kept.
    Most(&'f Linear, &'f AtomicI64),
}

impl<'f> Goal<'f> {
    /// `None` when the formula has temporal operators.
    pub fn new(formula: &'f Formula) -> Option<Self> {
        formula.is_state().then_some(Self(Asked::Formula(formula)))
    }

    /// What holds in no marking, and keeps the most that a sum is in those that it is asked of.
    pub(super) const fn most(sum: &'f Linear, most: &'f AtomicI64) -> Self {
        Self(Asked::Most(sum, most))
    }

    /// What tells whether it holds in markings of a space.
    pub(super) fn packed(self, space: &Space) -> Packed<'f> {
        let asks = |it: &Formula| matches!(it, Formula::Atom(Atom::Fireable(_) | Atom::Deadlock));
        let looks = matches!(self.0, Asked::Formula(formula) if formula.any(&asks));
        Packed { goal: self, looks: looks || space.layout.computed > 0 }
    }
}

/// A goal for the markings of a space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packed<'f> {
    goal: Goal<'f>,
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
        self.goal.holds(&Look::packed(space, packed, view))
    }
}

impl Goal<'_> {
    /// Whether it holds in a marking.
    pub(super) fn holds(self, look: &Look<'_>) -> bool {
        match self.0 {
            Asked::Formula(formula) => holds(formula, look),
            Asked::Most(sum, most) => {
                let value = sum.value(look).clamp(i64::MIN.into(), i64::MAX.into());
                most.fetch_max(value as i64, Relaxed);
                false
            }
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
