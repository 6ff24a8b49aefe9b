//! Parts of a formula, each once.

use std::collections::HashMap;
use std::hash::Hash;

/// Nodes that share what is equal; a node speaks of nodes before it only.
pub(super) struct Nodes<N> {
    list: Vec<N>,
    positions: HashMap<N, u32>,
}

impl<N> Default for Nodes<N> {
    fn default() -> Self {
        Self { list: Vec::new(), positions: HashMap::new() }
    }
}

impl<N: Clone + Eq + Hash> Nodes<N> {
    /// Returns the position of a node, which is added if it is new.
    pub(super) fn push(&mut self, node: N) -> u32 {
        if let Some(&at) = self.positions.get(&node) {
            return at;
        }
        let at = self.list.len() as u32;
        self.positions.insert(node.clone(), at);
        self.list.push(node);
        at
    }

    /// Returns the node at a position.
    pub(super) fn at(&self, position: u32) -> &N {
        &self.list[position as usize]
    }

    /// Returns all nodes in their order.
    pub(super) fn into_list(self) -> Vec<N> {
        self.list
    }
}
