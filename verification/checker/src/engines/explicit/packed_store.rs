//! Packed markings as the store of a graph, with what was found of formulas.

use super::bits::BitSet;
use super::goal::Goal;
use super::labels::Labels;
use super::look::Look;
use super::packed::Packed;
use super::store::{Asked, MarkingStore};
use cotama_core::net::PlaceId;

/// Packed markings, and labels: the markings in which inequalities hold.
#[derive(Debug)]
pub(super) struct PackedStore {
    pub(super) packed: Packed,
    pub(super) labels: Labels,
}

impl MarkingStore for PackedStore {
    fn each(&self, states: &mut dyn Iterator<Item = u32>, look: &mut dyn FnMut(&Look<'_>)) {
        self.packed.each(states, look);
    }

    fn bytes(&self) -> u64 {
        self.packed.bytes() + self.labels.bytes(self.packed.len())
    }

    fn marking(&self, state: u32) -> Vec<u32> {
        self.packed.marking(state)
    }

    fn held(&self, state: u32, place: PlaceId) -> u64 {
        self.packed.held(state, place)
    }

    fn tokens(&self, place: PlaceId, _: u32) -> Box<dyn Iterator<Item = u32> + '_> {
        Box::new(self.packed.tokens(place))
    }

    fn satisfying(&self, goal: Goal<'_>, asked: Asked<'_>) -> BitSet {
        let labelled = self.labels.satisfying(&self.packed, goal, asked);
        labelled.unwrap_or_else(|| self.packed.satisfying(goal, asked))
    }
}
