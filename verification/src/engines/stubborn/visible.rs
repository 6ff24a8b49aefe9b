//! What a formula sees.

use crate::property::{Atom, Formula, Linear};
use crate::pt::Pt;

/// For each transition whether firing it may change a formula about one marking.
pub(crate) fn visible(pt: &Pt, formula: &Formula) -> Vec<bool> {
    let mut visible = vec![false; pt.transitions.len()];
    see(pt, formula, &mut visible);
    visible
}

fn see(pt: &Pt, formula: &Formula, visible: &mut [bool]) {
    match formula {
        Formula::Atom(Atom::AtMost(linear)) => {
            for transition in linear.changers(pt) {
                visible[transition as usize] |= linear.change(pt, transition) != 0;
            }
        }
        Formula::Atom(Atom::Fireable(transitions)) => {
            let places = transitions.iter().flat_map(|it| pt.needs.of(it.0));
            for &(changer, _) in places.flat_map(|it| pt.changers.of(it.0)) {
                visible[changer as usize] = true;
            }
        }
        Formula::Not(inner) => see(pt, inner, visible),
        Formula::And(all) | Formula::Or(all) => all.iter().for_each(|it| see(pt, it, visible)),
        _ => visible.fill(true),
    }
}

impl Linear {
    /// The transitions that change one of its places, in their order.
    pub(super) fn changers(&self, pt: &Pt) -> Vec<u32> {
        let changers = self.weights.iter().flat_map(|it| pt.changers.of(it.0.0));
        let mut all: Vec<u32> = changers.map(|it| it.0).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// By how much firing a transition changes the sum.
    pub(super) fn change(&self, pt: &Pt, transition: u32) -> i128 {
        let effect = |place: u32| {
            let effects = pt.effects.of(transition);
            effects.binary_search_by_key(&place, |it| it.0).map_or(0, |at| effects[at].1)
        };
        self.weights
            .iter()
            .map(|&(place, weight)| i128::from(weight) * i128::from(effect(place.0)))
            .sum()
    }
}
