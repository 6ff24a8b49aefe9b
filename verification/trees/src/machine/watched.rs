//! Nodes and the supervisor, as a condition after a tick asks for them.

use super::Machine;
use std::collections::BTreeSet;

/// Parts of a machine that are kept for a condition, also where a run has ended.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watched {
    /// Nodes whose last answer within the tick is asked for.
    pub(crate) nodes: BTreeSet<usize>,
    /// Nodes whose status is asked for, also where it is left by an exception.
    pub(crate) statuses: BTreeSet<usize>,
    /// The state of the supervisor is asked for.
    pub(crate) net: bool,
}

impl Watched {
    /// Returns whether nothing is asked for.
    pub(crate) fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.statuses.is_empty() && !self.net
    }
}

impl Machine<'_> {
    /// Makes a cell for each watched node, which notes its answer of the tick.
    pub(crate) fn watch(&mut self, watched: &Watched) {
        for &node in &watched.nodes {
            self.watched[node] = Some(self.cells.len());
            self.cells.push(0);
            self.layout.widths.push(3);
        }
        self.kept.extend(&watched.statuses);
        if watched.net {
            self.watch_net();
        }
    }
}
