//! One step of the whole system, gathered from what its nets do in it.

use cotama_core::net::{OutputId, PlaceId};
use std::collections::BTreeMap;

/// A step of several effects, one after the other: tokens that must be there before all of it, and
/// the changes.
#[derive(Clone, Debug, Default)]
pub(super) struct Step {
    pub(super) name: Vec<String>,
    pub(super) needs: BTreeMap<PlaceId, i64>,
    pub(super) effects: BTreeMap<PlaceId, i64>,
    pub(super) outputs: Vec<OutputId>,
}

impl Step {
    /// Adds that a place must hold so many tokens by now, and then changes.
    pub(super) fn then(&mut self, place: PlaceId, need: i64, change: i64) {
        let effect = self.effects.entry(place).or_default();
        let before = self.needs.entry(place).or_default();
        *before = (*before).max(need - *effect);
        *effect += change;
    }
}
