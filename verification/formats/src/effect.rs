//! The changes that the firing of a transition makes.

use cotama_core::net::{Arc, PlaceId, Transition};
use std::collections::BTreeMap;

/// Tokens that a firing adds to each place, less those that it removes; places without a change are
/// left out.
pub(super) fn effect(transition: &Transition<'_>) -> BTreeMap<PlaceId, i64> {
    let mut effect = BTreeMap::new();
    let mut add = |arcs: &[Arc], sign: i64| {
        for arc in arcs {
            *effect.entry(arc.place).or_insert(0) += sign * i64::from(arc.weight);
        }
    };
    add(transition.give, 1);
    add(transition.take, -1);
    effect.retain(|_, change| *change != 0);
    effect
}
