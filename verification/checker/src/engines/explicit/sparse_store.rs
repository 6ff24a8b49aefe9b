//! Differences from the initial marking as the store of a graph.

use super::look::Look;
use super::sparse::{Cursor, Sparse};
use super::store::MarkingStore;
use cotama_core::net::PlaceId;
use std::sync::{Mutex, PoisonError};

/// Markings of a net that is too wide to be packed, and the one that was looked at last.
#[derive(Debug)]
pub(super) struct SparseStore {
    markings: Sparse,
    cursor: Mutex<Cursor>,
}

impl SparseStore {
    pub(super) fn new(markings: Sparse, cursor: Cursor) -> Self {
        Self { markings, cursor: Mutex::new(cursor) }
    }
}

impl MarkingStore for SparseStore {
    fn each(&self, states: &mut dyn Iterator<Item = u32>, look: &mut dyn FnMut(&Look<'_>)) {
        let mut cursor = self.cursor.lock().unwrap_or_else(PoisonError::into_inner);
        states.for_each(|state| look(&self.markings.look(&mut cursor, state)));
    }

    fn bytes(&self) -> u64 {
        self.markings.bytes()
    }

    fn marking(&self, state: u32) -> Vec<u32> {
        self.markings.marking(state)
    }

    fn held(&self, state: u32, place: PlaceId) -> u64 {
        self.markings.tokens(state, place.0).into()
    }
}
