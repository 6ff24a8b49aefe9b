//! Leaves that are asked before an entry that they read was written.

use super::Space;
use super::graph::What;
use crate::machine::{Event, How, Reply};
use crate::tree::{Answer, Kind};
use std::collections::VecDeque;

/// A leaf, the entry, and how it comes about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Unwritten {
    pub(crate) node: usize,
    pub(crate) entry: (usize, String),
    pub(crate) ticks: u32,
    /// Edges of a run with the fewest ticks, up to the question.
    pub(crate) path: Vec<usize>,
}

impl Space<'_> {
    /// Returns all of them; entries of `given` count as written from the beginning.
    pub(crate) fn unwritten(&mut self, given: &[String]) -> Vec<Unwritten> {
        let nodes = &self.tree.nodes;
        let mut entries: Vec<&(usize, String)> = nodes.iter().flat_map(|it| &it.writes).collect();
        entries.sort();
        entries.dedup();
        let is_read = |entry: &&(usize, String)| nodes.iter().any(|it| it.reads.contains(entry));
        let is_given = |it: &(usize, String)| it.0 == 0 && given.contains(&it.1);
        entries.retain(|it| is_read(it) && !is_given(it));
        let entries: Vec<_> = entries.into_iter().cloned().collect();
        let mut found = Vec::new();
        for entry in entries {
            self.before(&entry, &mut found);
        }
        found
    }

    /// Walks through what happens before an entry is written.
    fn before(&mut self, entry: &(usize, String), found: &mut Vec<Unwritten>) {
        let tree = self.tree;
        let mut ticks = vec![u32::MAX; self.len()];
        let mut via = vec![(u32::MAX, 0_u32); self.len()];
        let mut waiting = VecDeque::from([0_usize]);
        ticks[0] = 0;
        let mut done: Vec<usize> = Vec::new();
        while let Some(point) = waiting.pop_front() {
            let asks = match self.what(point) {
                What::Asks(node) if node < tree.nodes.len() => Some(node),
                _ => None,
            };
            if let Some(node) = asks
                && tree.nodes[node].reads.contains(entry)
                && matches!(tree.nodes[node].kind, Kind::Leaf(_) | Kind::Loop { .. })
                && !done.contains(&node)
                && self.starts(point)
            {
                done.push(node);
                let mut path = Vec::new();
                let mut at = point as u32;
                while via[at as usize].0 != u32::MAX {
                    let (before, edge) = via[at as usize];
                    path.push(edge as usize);
                    at = before;
                }
                path.reverse();
                let ticks = ticks[point] + 1;
                found.push(Unwritten { node, entry: entry.clone(), ticks, path });
            }
            let writes = asks.is_some_and(|it| tree.nodes[it].writes.contains(entry));
            for edge in self.out(point) {
                let it = self.edges[edge];
                if writes && it.reply() == Some(Reply::Leaf(Answer::Success)) {
                    continue;
                }
                // A leaf that acts on the supervisor writes without being asked.
                let bound = self.tree.bonds.is_some()
                    && self.events(edge).iter().any(|it| match *it {
                        Event::Itself(node, Answer::Success) => {
                            tree.bond(node as usize).is_some()
                                && tree.nodes[node as usize].writes.contains(entry)
                        }
                        _ => false,
                    });
                if bound {
                    continue;
                }
                let target = it.target as usize;
                let whole = self.is_state(target);
                let level = ticks[point] + whole as u32;
                if level >= ticks[target] {
                    continue;
                }
                ticks[target] = level;
                via[target] = (point as u32, edge as u32);
                if whole {
                    waiting.push_back(target);
                } else {
                    waiting.push_front(target);
                }
            }
        }
    }

    /// Returns whether a leaf is asked without running, or a loop whether an item is left.
    fn starts(&mut self, point: usize) -> bool {
        self.at(point).question().is_some_and(|it| it.how != How::Goes)
    }
}
