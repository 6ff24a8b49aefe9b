//! Where the parts of a formula of CTL hold.

use super::fairness::{Fair, FairSets, Fairness};
use crate::explicit::{Goal, Graph};
use crate::property::{Ctl, CtlNode};

/// What is known of the parts of a formula in the markings of a graph.
pub(super) struct Labelling<'g> {
    pub(super) graph: &'g Graph,
    pub(super) formula: &'g Ctl,
    pub(super) fair: Fair<'g>,
    /// States from which some fair run goes; `None` when all runs are fair.
    pub(super) fair_states: Option<Vec<bool>>,
    before: Option<Predecessors>,
    pub(super) labels: Vec<Option<Vec<bool>>>,
    pub(super) ranks: Vec<Option<Vec<u32>>>,
}

impl<'g> Labelling<'g> {
    /// Nothing is looked at yet, but what fairness asks for.
    pub(super) fn new(graph: &'g Graph, formula: &'g Ctl, fairness: &Fairness<'g>) -> Self {
        let nodes = formula.nodes().len();
        let mut labelling = Self {
            graph,
            formula,
            fair: Fair::new(graph, fairness),
            fair_states: None,
            before: None,
            labels: vec![None; nodes],
            ranks: vec![None; nodes],
        };
        if !fairness.is_none() {
            labelling.fair_states = Some(labelling.always(&vec![true; graph.states()]));
        }
        labelling
    }
}

impl Labelling<'_> {
    /// Whether a part holds in the initial marking; parts of it that do not matter for this are not
    /// looked at.
    pub(super) fn holds(&mut self, node: u32) -> bool {
        match &self.formula.nodes()[node as usize] {
            CtlNode::Not(a) => !self.holds(*a),
            CtlNode::And(all) => all.iter().all(|it| self.holds(*it)),
            CtlNode::Or(all) => all.iter().any(|it| self.holds(*it)),
            _ => self.label(node)[0],
        }
    }

    /// Where a part holds. Nesting is as deep as formulas may be.
    fn label(&mut self, node: u32) -> &[bool] {
        if self.labels[node as usize].is_none() {
            let label = self.labelled(node);
            self.labels[node as usize] = Some(label);
        }
        self.labels[node as usize].as_deref().unwrap_or(&[])
    }

    fn labelled(&mut self, node: u32) -> Vec<bool> {
        let (states, graph) = (self.graph.states(), self.graph);
        match &self.formula.nodes()[node as usize] {
            CtlNode::State(state) => {
                Goal::new(state).map_or(vec![false; states], |it| graph.satisfying(it))
            }
            CtlNode::Not(a) => self.label(*a).iter().map(|it| !it).collect(),
            CtlNode::And(all) => {
                let mut holds = vec![true; states];
                for part in all {
                    holds.iter_mut().zip(self.label(*part)).for_each(|(holds, it)| *holds &= it);
                }
                holds
            }
            CtlNode::Or(all) => {
                let mut holds = vec![false; states];
                for part in all {
                    holds.iter_mut().zip(self.label(*part)).for_each(|(holds, it)| *holds |= it);
                }
                holds
            }
            CtlNode::Next(a) => {
                let goal = self.fair_and(*a);
                let some = |state| graph.successors(state).iter().any(|it| goal[*it as usize]);
                (0..states as u32).map(some).collect()
            }
            CtlNode::Until(a, b) => {
                let goal = self.fair_and(*b);
                let through = self.label(*a).to_vec();
                let ranks = self.backward(&goal, &through);
                let holds = ranks.iter().map(|it| *it != u32::MAX).collect();
                self.ranks[node as usize] = Some(ranks);
                holds
            }
            CtlNode::Globally(a) => {
                let region = self.label(*a).to_vec();
                self.always(&region)
            }
        }
    }

    fn fair_and(&mut self, node: u32) -> Vec<bool> {
        let mut holds = self.label(node).to_vec();
        if let Some(fair) = &self.fair_states {
            holds.iter_mut().zip(fair).for_each(|(holds, it)| *holds &= it);
        }
        holds
    }

    /// From which states of a region a fair run stays in it for ever.
    fn always(&mut self, region: &[bool]) -> Vec<bool> {
        let sets = self.fair.sets(region);
        let goal: Vec<bool> = (0..region.len() as u32).map(|it| sets.has(it)).collect();
        self.backward(&goal, region).into_iter().map(|it| it != u32::MAX).collect()
    }

    pub(super) fn sets(&self, region: &[bool]) -> FairSets {
        self.fair.sets(region)
    }

    /// For each state how many firings through such states a goal is away; `u32::MAX` when none is
    /// reached.
    fn backward(&mut self, goal: &[bool], through: &[bool]) -> Vec<u32> {
        let graph = self.graph;
        let before = self.before.get_or_insert_with(|| Predecessors::new(graph));
        let mut ranks: Vec<u32> = goal.iter().map(|it| if *it { 0 } else { u32::MAX }).collect();
        let mut level: Vec<u32> = (0..goal.len() as u32).filter(|it| goal[*it as usize]).collect();
        let mut rank = 0;
        while !level.is_empty() {
            rank += 1;
            let mut next = Vec::new();
            for state in level {
                for &from in before.of(state) {
                    if through[from as usize] && ranks[from as usize] == u32::MAX {
                        ranks[from as usize] = rank;
                        next.push(from);
                    }
                }
            }
            level = next;
        }
        ranks
    }
}

/// For each state those that it follows.
struct Predecessors {
    starts: Vec<usize>,
    states: Vec<u32>,
}

impl Predecessors {
    fn new(graph: &Graph) -> Self {
        let count = graph.states();
        let mut starts = vec![0; count + 1];
        let arcs = || {
            (0..count as u32)
                .flat_map(|from| graph.successors(from).iter().map(move |to| (from, *to)))
        };
        for (_, to) in arcs() {
            starts[to as usize + 1] += 1;
        }
        for at in 0..count {
            starts[at + 1] += starts[at];
        }
        let (mut ends, mut states) = (starts.clone(), vec![0; graph.arcs()]);
        for (from, to) in arcs() {
            let end = &mut ends[to as usize];
            states[*end] = from;
            *end += 1;
        }
        Self { starts, states }
    }

    fn of(&self, state: u32) -> &[u32] {
        &self.states[self.starts[state as usize]..self.starts[state as usize + 1]]
    }
}
