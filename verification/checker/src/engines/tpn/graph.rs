//! State classes as states that temporal logic is about.

use super::classes::Classes;
use super::markings::Markings;
use crate::explicit::{BitSet, Goal};
use crate::temporal::Successors;
use cotama_core::net::TransitionId;
use cotama_property::Condition;
use cotama_property::pt::Pt;
use std::collections::VecDeque;

/// Classes with the firings between them.
#[derive(Debug)]
pub(crate) struct ClassGraph {
    pt: Pt,
    /// The tokens of all markings, one after the other.
    tokens: Vec<u32>,
    marking_of: Vec<u32>,
    starts: Vec<usize>,
    targets: Vec<u32>,
    fired: Vec<TransitionId>,
}

impl ClassGraph {
    pub(super) fn new<'e>(
        pt: Pt,
        markings: &Markings,
        marking_of: Vec<u32>,
        edges: impl Iterator<Item = &'e [(TransitionId, u32)]>,
    ) -> Self {
        let (mut starts, mut targets, mut fired) = (vec![0], Vec::new(), Vec::new());
        for edges in edges {
            targets.extend(edges.iter().map(|it| it.1));
            fired.extend(edges.iter().map(|it| it.0));
            starts.push(targets.len());
        }
        let tokens = (0..markings.len() as u32).flat_map(|it| markings.tokens(it)).copied();
        Self { tokens: tokens.collect(), pt, marking_of, starts, targets, fired }
    }

    /// Whether from each class each transition can fire, at once or later.
    pub(crate) fn is_live(&self) -> bool {
        let states = self.states();
        let mut before = vec![Vec::new(); states];
        for from in 0..states as u32 {
            for (arc, &to) in (self.starts[from as usize]..).zip(self.successors(from)) {
                before[to as usize].push((from, self.fired[arc]));
            }
        }
        (0..self.pt.transitions.len() as u32).map(TransitionId).all(|transition| {
            let mut can = BitSet::new(states, false);
            let fires = before.iter().flatten().filter(|it| it.1 == transition);
            let mut open: Vec<u32> = fires.map(|it| it.0).collect();
            while let Some(state) = open.pop() {
                if !can.has(state) {
                    can.insert(state);
                    open.extend(before[state as usize].iter().map(|it| it.0));
                }
            }
            can.iter().all(|it| it)
        })
    }

    /// About how many bytes it takes.
    pub(crate) fn bytes(&self) -> u64 {
        let words = self.tokens.len() + self.marking_of.len() + 2 * self.targets.len();
        4 * words as u64 + 8 * self.starts.len() as u64
    }
}

/// The linear classes of a net, all of them.
impl From<&Classes> for ClassGraph {
    fn from(classes: &Classes) -> Self {
        let marking_of = classes.list.iter().map(|it| it.0).collect();
        let edges = (0..classes.classes() as u32).map(|it| classes.successors(it));
        Self::new(classes.rules.pt.clone(), &classes.markings, marking_of, edges)
    }
}

impl Successors for ClassGraph {
    fn states(&self) -> usize {
        self.marking_of.len()
    }

    fn arcs(&self) -> usize {
        self.targets.len()
    }

    fn successors(&self, state: u32) -> &[u32] {
        &self.targets[self.starts[state as usize]..self.starts[state as usize + 1]]
    }

    fn transitions(&self, state: u32) -> Vec<TransitionId> {
        self.fired[self.starts[state as usize]..self.starts[state as usize + 1]].to_vec()
    }

    /// Classes are few: one thread looks at each marking once.
    fn satisfying(&self, goal: Goal<'_>, _: usize) -> BitSet {
        let mut set = BitSet::new(self.states(), false);
        let condition = goal.formula().and_then(|it| Condition::new(it, &self.pt));
        let Some(condition) = condition else { return set };
        let markings = self.tokens.chunks(self.pt.initial.len().max(1));
        let holds: Vec<bool> = markings.map(|it| condition.holds(it)).collect();
        // A net without places has one marking.
        let empty = condition.holds([0_u32; 0].as_slice());
        for (class, marking) in (0..).zip(&self.marking_of) {
            if holds.get(*marking as usize).copied().unwrap_or(empty) {
                set.insert(class);
            }
        }
        set
    }

    fn path(&self, to: u32) -> Vec<TransitionId> {
        let mut before = vec![None; self.states()];
        let mut queue = VecDeque::from([0_u32]);
        while let Some(state) = queue.pop_front().filter(|it| *it != to) {
            let start = self.starts[state as usize];
            for (arc, &next) in (start..).zip(self.successors(state)) {
                if next != 0 && before[next as usize].is_none() {
                    before[next as usize] = Some((state, self.fired[arc]));
                    queue.push_back(next);
                }
            }
        }
        let (mut path, mut state) = (Vec::new(), to);
        while let Some((from, fired)) = before[state as usize] {
            path.push(fired);
            state = from;
        }
        path.reverse();
        path
    }
}
