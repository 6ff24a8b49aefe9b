//! The transitions that a formula sees.

use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula, Linear};

/// For each transition whether firing it may change a formula about one marking.
pub(crate) fn visible(pt: &Pt, formula: &Formula) -> Vec<bool> {
    let mut visible = vec![false; pt.transitions.len()];
    see(pt, formula, &mut visible);
    visible
}

fn see(pt: &Pt, formula: &Formula, visible: &mut [bool]) {
    match formula {
        Formula::Atom(Atom::AtMost(linear)) => {
            for transition in changers(pt, linear) {
                visible[transition as usize] |= change(pt, linear, transition) != 0;
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

/// Returns the transitions that change a place of a sum, in their order.
pub(super) fn changers(pt: &Pt, sum: &Linear) -> Vec<u32> {
    let changers = sum.weights.iter().flat_map(|it| pt.changers.of(it.0.0));
    let mut all: Vec<u32> = changers.map(|it| it.0).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Returns by how much firing a transition changes a sum.
pub(super) fn change(pt: &Pt, sum: &Linear, transition: u32) -> i128 {
    let effect = |place: u32| {
        let effects = pt.effects.of(transition);
        effects.binary_search_by_key(&place, |it| it.0).map_or(0, |at| effects[at].1)
    };
    sum.weights
        .iter()
        .map(|&(place, weight)| i128::from(weight) * i128::from(effect(place.0)))
        .sum()
}
