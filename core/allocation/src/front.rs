//! The front: every plan within the limits that no other plan beats on all axes and in quality.
//!
//! A dynamic programme over the activities: partial plans that cannot be completed within a limit
//! are dropped, and so is one that another partial plan over the same activities dominates (no
//! dearer on any axis, no worse in quality). What is left after the last activity is the front,
//! each vector of totals once; of plans with equal totals the one first in the order of choices is
//! kept. The memory it needs is not known before; when the caller's does not suffice, that is the
//! answer.
//!
//! ```
//! use cotama_core::front::{Front, Node};
//! use cotama_core::problem::{Candidate, Problem};
//!
//! let c = |duration, energy, quality| Candidate { cost: [duration, energy], quality, id: 0 };
//! let (a, b) = ([c(1, 9, 0), c(9, 1, 0), c(9, 9, 0)], [c(1, 1, 5), c(2, 2, 6)]);
//! let activities = [&a[..], &b[..]];
//! let problem = Problem::new(&activities, [100, 10], [0, 1]).unwrap();
//!
//! let mut nodes = [Node::EMPTY; 16];
//! let mut front = Front::new(&mut nodes);
//! let plans = front.find(&problem).unwrap();
//! // (2, 10, 5), (10, 2, 5) and (11, 3, 6); (3, 11, 6) is over the energy limit.
//! assert_eq!(plans.len(), 3);
//! let mut plan = [0; 2];
//! assert_eq!(plans.totals(0), Some(([2, 10], 5)));
//! assert!(plans.plan(0, &mut plan));
//! assert_eq!(plan, [0, 0]);
//! ```

#[cfg(kani)]
pub mod proofs;

use crate::allocation::MemoryError;
use crate::order::{keep_undominated, numbered, sort_by_key};
use crate::problem::{Problem, cheapest};
use core::cmp::Reverse;

/// Working memory for one partial plan.
#[derive(Clone, Copy, Debug)]
pub struct Node<const A: usize> {
    cost: [u64; A],
    quality: u64,
    /// The partial plan that this one extends: an index into the memory.
    parent: u32,
    choice: u16,
}

impl<const A: usize> Node<A> {
    /// Unused memory.
    pub const EMPTY: Self = Self { cost: [0; A], quality: 0, parent: 0, choice: 0 };

    fn dominates(&self, other: &Self) -> bool {
        self.quality >= other.quality
            && self.cost.iter().zip(&other.cost).all(|(mine, theirs)| mine <= theirs)
    }
}

/// Finds fronts, in memory from its caller.
#[derive(Debug)]
pub struct Front<'m, const A: usize> {
    nodes: &'m mut [Node<A>],
}

/// The plans of a front, in rising order of cost (axis after axis), then falling quality.
///
/// ```
/// use cotama_core::front::{Front, Node};
/// use cotama_core::problem::{Candidate, Problem};
///
/// let c = |duration, energy| Candidate { cost: [duration, energy], quality: 0, id: 0 };
/// let ways = [c(1, 9), c(4, 4), c(9, 9), c(8, 1)];
/// let activities = [&ways[..]];
/// let problem = Problem::new(&activities, [10, 10], [0, 1]).unwrap();
/// let mut nodes = [Node::EMPTY; 8];
/// let mut front = Front::new(&mut nodes);
/// let plans = front.find(&problem).unwrap();
/// let costs: Vec<_> = (0..plans.len()).filter_map(|at| Some(plans.totals(at)?.0)).collect();
/// assert_eq!(costs, [[1, 9], [4, 4], [8, 1]]); // (9, 9) is beaten by all of them
/// assert!(front.find(&problem.with_limits([0, 10])).unwrap().is_empty());
/// ```
#[derive(Debug)]
pub struct FrontPlans<'f, const A: usize> {
    nodes: &'f [Node<A>],
    first: usize,
    activities: usize,
}

impl<'m, const A: usize> Front<'m, A> {
    /// A finder in this memory. It must hold the undominated partial plans after every activity,
    /// and the extensions of the last ones; at most 2^32 elements are used.
    pub const fn new(nodes: &'m mut [Node<A>]) -> Self {
        Self { nodes }
    }

    /// The front of a problem; without plans when nothing is within the limits.
    ///
    /// # Errors
    /// [`MemoryError`] when the memory is too small. `needed` is then what the activity at hand
    /// needed at least.
    pub fn find(&mut self, problem: &Problem<'_, A>) -> Result<FrontPlans<'_, A>, MemoryError> {
        let activities = problem.activities();
        let given = self.nodes.len().min(u32::MAX as usize);
        let nodes = self.nodes.get_mut(..given).unwrap_or(&mut []);
        let short = |needed| MemoryError { what: "nodes of the front", needed, given };
        let mut rest: [u64; A] = core::array::from_fn(|axis| problem.least(axis));

        *nodes.first_mut().ok_or(short(1))? = Node::EMPTY;
        let (mut first, mut end) = (0usize, 1usize);
        for candidates in activities {
            for (axis, rest) in numbered(&mut rest) {
                let cheapest = u64::from(cheapest(candidates, axis));
                debug_assert!(cheapest <= *rest, "the activities that are left take it");
                *rest = rest.saturating_sub(cheapest);
            }
            let mut room = problem.limits();
            for (room, &rest) in room.iter_mut().zip(&rest) {
                *room = room.saturating_sub(rest);
            }
            let mut next = end;
            for parent in first..end {
                debug_assert!(parent < end && end <= nodes.len(), "a node that was made");
                let Some(&from) = nodes.get(parent) else { break };
                for (choice, candidate) in numbered(candidates.iter()) {
                    let mut cost = from.cost;
                    for (sum, &part) in cost.iter_mut().zip(&candidate.cost) {
                        *sum = sum.saturating_add(u64::from(part));
                    }
                    if cost.iter().zip(&room).any(|(cost, room)| cost > room) {
                        continue;
                    }
                    let quality = from.quality.saturating_add(u64::from(candidate.quality));
                    let all = end.wrapping_sub(first).saturating_mul(candidates.len());
                    let place = nodes.get_mut(next).ok_or(short(end.saturating_add(all)))?;
                    *place = Node { cost, quality, parent: parent as u32, choice: choice as u16 };
                    next = next.wrapping_add(1);
                }
            }
            let kept = undominated(nodes.get_mut(end..next).unwrap_or(&mut []));
            debug_assert!(end + kept <= next, "nodes are only dropped");
            (first, end) = (end, end.wrapping_add(kept));
        }
        let within = problem.within_limits(&core::array::from_fn(|axis| problem.least(axis)));
        let first = if within { first } else { end };
        let nodes = nodes.get(..end).unwrap_or(&[]);
        Ok(FrontPlans { nodes, first, activities: activities.len() })
    }
}

/// Sorts partial plans and moves the undominated ones to the front; returns their number.
fn undominated<const A: usize>(nodes: &mut [Node<A>]) -> usize {
    sort_by_key(nodes, |node| (node.cost, Reverse(node.quality), node.parent, node.choice));
    // Each plan that dominates another comes before it; the nearest are the likeliest.
    let kept = keep_undominated(nodes, usize::MAX, Node::dominates);
    debug_assert!(kept.is_sorted_by_key(|node| node.cost), "cheaper plans come first");
    kept.len()
}

impl<const A: usize> FrontPlans<'_, A> {
    /// How many plans there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.nodes.len().saturating_sub(self.first)
    }

    /// Whether there is none: nothing is within the limits.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The total cost on each axis and the quality of a plan.
    #[must_use]
    pub fn totals(&self, index: usize) -> Option<([u64; A], u64)> {
        self.nodes.get(self.first.checked_add(index)?).map(|node| (node.cost, node.quality))
    }

    /// Writes the choices of a plan; `false`, and nothing written, if there is no such plan or no
    /// room for it.
    pub fn plan(&self, index: usize, plan: &mut [u16]) -> bool {
        let at = self.first.checked_add(index);
        let Some(mut node) = at.and_then(|at| self.nodes.get(at)) else { return false };
        let Some(plan) = plan.get_mut(..self.activities) else { return false };
        for choice in plan.iter_mut().rev() {
            *choice = node.choice;
            node = self.nodes.get(node.parent as usize).unwrap_or(node);
        }
        true
    }
}
