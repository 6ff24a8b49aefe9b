//! Strongly connected components.
//!
//! One routine for all engines. What looks for something else does it otherwise: the search for a
//! run of LTL (`temporal/emptiness.rs`) merges components while it meets the markings and ends as
//! soon as one has what it needs; the checker of certificates shares nothing with the engines.

use std::ops::ControlFlow;

/// Sets of nodes of a graph that can all be reached from each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// For each node its component. Arcs lead to components with smaller numbers, or stay.
    pub of: Vec<u32>,
    /// How many components there are.
    pub count: u32,
}

/// The components of a graph of so many nodes, which tells the successor of a node at a position,
/// counted from 0.
pub(crate) fn components(nodes: usize, mut graph: impl Fn(u32, u32) -> Option<u32>) -> Components {
    let mut search = Search::new(nodes);
    for root in 0..nodes as u32 {
        if search.pass(&mut graph, root).is_break() {
            break;
        }
    }
    let Search { ranks: mut of, count, .. } = search;
    for it in &mut of {
        debug_assert!(*it != 0, "each node is met");
        *it = nodes as u32 - *it;
    }
    debug_assert!(of.iter().all(|it| *it < count));
    Components { of, count }
}

/// A directed graph, and what is done on the way through it.
pub(crate) trait Digraph {
    /// A node is met; this comes once, before its successors are asked for.
    fn meet(&mut self, _node: u32) {}

    /// The successor of a node at this position, counted from 0.
    fn successor(&mut self, node: u32, at: u32) -> Option<u32>;

    /// All successors of a node are met, and their successors.
    fn leave(&mut self, _node: u32) {}

    /// These nodes are a component. Arcs lead from them to components that came before, or stay.
    fn component(&mut self, _members: &[u32]) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: Fn(u32, u32) -> Option<u32>> Digraph for F {
    fn successor(&mut self, node: u32, at: u32) -> Option<u32> {
        self(node, at)
    }
}

/// A search for strongly connected components: that of D. J. Pearce, *A space-efficient algorithm
/// for finding strongly connected components*, Information Processing Letters 116 (2016), without
/// recursion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Search {
    /// Zero for a node that was not met; for one whose component is open the least that it leads
    /// back to, as numbers in the order in which they were met; for others the number of nodes
    /// minus the number of the component, which is never less.
    ranks: Vec<u32>,
    /// How many components are complete.
    count: u32,
    /// Nodes that are left, and wait for the one that they lead back to.
    waiting: Vec<u32>,
    visits: Vec<Visit>,
}

/// A node that is being visited.
#[derive(Clone, Debug)]
struct Visit {
    node: u32,
    /// Position of the next successor.
    next: u32,
    /// When it was met.
    rank: u32,
}

impl Search {
    /// A search in a graph of so many nodes.
    pub(crate) fn new(nodes: usize) -> Self {
        Self { ranks: vec![0; nodes], ..Self::default() }
    }

    /// Forgets all that was met, which is at most these nodes.
    pub(crate) fn forget(&mut self, met: &[u32]) {
        for node in met {
            self.ranks[*node as usize] = 0;
        }
        self.count = 0;
        self.waiting.clear();
        self.visits.clear();
    }

    /// Meets a node and all that it leads to, as far as they were not met before. After a break the
    /// search is good for nothing but to [`forget`](Self::forget).
    pub(crate) fn pass(&mut self, graph: &mut impl Digraph, root: u32) -> ControlFlow<()> {
        let (nodes, ranks) = (self.ranks.len() as u32, &mut self.ranks[..]);
        if ranks[root as usize] != 0 {
            return ControlFlow::Continue(());
        }
        // How many nodes are in open components, and the least that the visited one leads back to.
        let (mut open, mut low) = (1, 1);
        let mut visit = Visit { node: root, next: 0, rank: open };
        ranks[root as usize] = open;
        graph.meet(root);
        loop {
            let Visit { node, mut next, rank } = visit;
            let new = loop {
                let Some(to) = graph.successor(node, next) else { break None };
                let back = ranks[to as usize];
                if back == 0 {
                    break Some(to);
                }
                low = low.min(back);
                next += 1;
            };
            ranks[node as usize] = low;
            if let Some(to) = new {
                // When it is left, what it leads back to is asked for.
                self.visits.push(Visit { node, next, rank });
                open += 1;
                low = open;
                visit = Visit { node: to, next: 0, rank: open };
                ranks[to as usize] = open;
                graph.meet(to);
                continue;
            }
            graph.leave(node);
            self.waiting.push(node);
            if low == rank {
                // Root of a component: the members waiting behind it are popped.
                let mut first = self.waiting.len();
                while let Some(&member) = self.waiting[..first].last()
                    && ranks[member as usize] >= rank
                {
                    ranks[member as usize] = nodes - self.count;
                    first -= 1;
                }
                debug_assert!(first < self.waiting.len(), "its root is a member");
                open -= (self.waiting.len() - first) as u32;
                self.count += 1;
                debug_assert!(self.count <= nodes);
                graph.component(&self.waiting[first..])?;
                self.waiting.truncate(first);
            }
            let Some(before) = self.visits.pop() else { return ControlFlow::Continue(()) };
            visit = before;
            low = ranks[visit.node as usize];
        }
    }
}
