//! Complement places: what they hold says again what their place holds.

use super::{Case, claim};
use cotama_core::net::{Role, TransitionId};
use cotama_property::{Atom, Question};
use std::collections::BTreeSet;

/// The places that a property names, and for transitions that it names these places, in their
/// order.
pub(super) fn asked(
    question: &Question,
    of_transition: impl Fn(TransitionId) -> Vec<u32>,
) -> Vec<u32> {
    let of_atom = |atom: &Atom| -> Vec<u32> {
        match atom {
            Atom::AtMost(linear) => linear.weights.iter().map(|it| it.0.0).collect(),
            Atom::Fireable(transitions) => {
                transitions.iter().flat_map(|it| of_transition(*it)).collect()
            }
            Atom::Deadlock => Vec::new(),
        }
    };
    match question {
        Question::Formula(formula) | Question::Fair(formula, _) => {
            claim::atoms(formula).iter().flat_map(of_atom).collect()
        }
        Question::Bound(places) => places.iter().map(|it| it.0).collect(),
        Question::Response { to, .. } => vec![to.0],
        _ => Vec::new(),
    }
}

/// For each place the one that it mirrors; `None` of those that mirror none, or that the property
/// names. A net of which only its structure is known has none.
pub(super) fn mirrored(case: &Case<'_>) -> Vec<Option<u32>> {
    let named: BTreeSet<u32> = asked(&case.property.question, |_| Vec::new()).into_iter().collect();
    let mut mirrored = vec![None; case.pt.places.len()];
    for (at, place) in case.net.iter().flat_map(|net| net.places.iter().enumerate()) {
        if let Role::Complement(of) = place.role
            && !named.contains(&(at as u32))
        {
            mirrored[at] = Some(of.0);
        }
    }
    mirrored
}
