//! Where the parts of a formula of CTL hold.

use super::fairness::{Fair, FairSets, Fairness};
use super::successors::Successors;
use crate::explicit::{BitSet, Goal, Limit, Memory};
use crate::property::{Ctl, CtlNode, Formula};
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::thread;

/// What is known of the parts of a formula in the states of a graph.
pub(super) struct Labelling<'g, S> {
    pub(super) graph: &'g S,
    pub(super) formula: &'g Ctl,
    pub(super) fair: Fair<'g, S>,
    /// States from which some fair run goes; `None` when all runs are fair.
    pub(super) fair_states: Option<BitSet>,
    before: Option<Predecessors>,
    pub(super) labels: Vec<Option<BitSet>>,
    pub(super) ranks: Vec<Option<Vec<u32>>>,
    memory: Memory,
    jobs: usize,
}

impl<'g, S: Successors> Labelling<'g, S> {
    /// Nothing is looked at yet, but what fairness asks for.
    pub(super) fn new(
        graph: &'g S,
        formula: &'g Ctl,
        fairness: &Fairness<'g>,
        (mut memory, jobs): (Memory, usize),
    ) -> Result<Self, Limit> {
        let nodes = formula.nodes().len();
        let mut labelling = Self {
            graph,
            formula,
            fair: Fair::new(graph, fairness, &mut memory, jobs)?,
            fair_states: None,
            before: None,
            labels: vec![None; nodes],
            ranks: vec![None; nodes],
            memory,
            jobs,
        };
        if !fairness.is_none() {
            let all = BitSet::new(graph.states(), true);
            labelling.fair_states = Some(labelling.always(&all)?);
        }
        Ok(labelling)
    }

    /// Whether a part holds in the first state; parts of it that do not matter for this are not
    /// looked at.
    pub(super) fn holds(&mut self, node: u32) -> Result<bool, Limit> {
        let formula = self.formula;
        Ok(match &formula.nodes()[node as usize] {
            CtlNode::Not(a) => !self.holds(*a)?,
            CtlNode::And(all) => {
                for it in all {
                    if !self.holds(*it)? {
                        return Ok(false);
                    }
                }
                true
            }
            CtlNode::Or(all) => {
                for it in all {
                    if self.holds(*it)? {
                        return Ok(true);
                    }
                }
                false
            }
            // All states are reached from the first one.
            CtlNode::Until(a, b) if self.fair_states.is_none() && self.is_true(*a) => {
                self.label(*b)?.ones().next().is_some() && self.label(node)?.has(0)
            }
            _ => self.label(node)?.has(0),
        })
    }

    fn is_true(&self, node: u32) -> bool {
        matches!(&self.formula.nodes()[node as usize],
            CtlNode::State(it) if *it == Formula::TRUE)
    }

    /// Where a part holds. Nesting is as deep as formulas may be.
    fn label(&mut self, node: u32) -> Result<&BitSet, Limit> {
        if self.labels[node as usize].is_none() {
            let label = self.labelled(node)?;
            self.labels[node as usize] = Some(label);
        }
        self.labels[node as usize].as_ref().ok_or(Limit::Bytes)
    }

    fn set(&mut self, all: bool) -> Result<BitSet, Limit> {
        let states = self.graph.states();
        self.memory.take(BitSet::bytes(states))?;
        Ok(BitSet::new(states, all))
    }

    fn labelled(&mut self, node: u32) -> Result<BitSet, Limit> {
        let (formula, graph) = (self.formula, self.graph);
        let mut holds = match &formula.nodes()[node as usize] {
            CtlNode::And(_) => self.set(true)?,
            _ => self.set(false)?,
        };
        match &formula.nodes()[node as usize] {
            CtlNode::State(state) => {
                if let Some(goal) = Goal::new(state) {
                    holds = graph.satisfying(goal, self.jobs);
                }
            }
            CtlNode::Not(a) => holds = self.label(*a)?.complement(),
            CtlNode::And(all) => {
                for part in all {
                    holds.and(self.label(*part)?);
                }
            }
            CtlNode::Or(all) => {
                for part in all {
                    holds.or(self.label(*part)?);
                }
            }
            CtlNode::Next(a) => {
                let goal = self.fair_and(*a)?;
                for state in 0..graph.states() as u32 {
                    if graph.successors(state).iter().any(|it| goal.has(*it)) {
                        holds.insert(state);
                    }
                }
            }
            CtlNode::Until(a, b) => {
                self.label(*a)?;
                self.label(*b)?;
                let bytes = 2 * BitSet::bytes(graph.states());
                self.memory.take(bytes)?;
                let goal = self.fair_and(*b)?;
                let through = self.label(*a)?.clone();
                let ranks = self.backward(&goal, &through)?;
                self.memory.release(bytes);
                for (state, _) in (0..).zip(&ranks).filter(|it| *it.1 != u32::MAX) {
                    holds.insert(state);
                }
                self.ranks[node as usize] = Some(ranks);
            }
            CtlNode::Globally(a) => {
                let region = self.label(*a)?.clone();
                holds = self.always(&region)?;
            }
        }
        Ok(holds)
    }

    fn fair_and(&mut self, node: u32) -> Result<BitSet, Limit> {
        let mut holds = self.label(node)?.clone();
        if let Some(fair) = &self.fair_states {
            holds.and(fair);
        }
        Ok(holds)
    }

    /// From which states of a region a fair run stays in it for ever.
    fn always(&mut self, region: &BitSet) -> Result<BitSet, Limit> {
        let states = self.graph.states();
        // Lists of the search for components, which are given back.
        let bytes = 24 * states as u64;
        self.memory.take(bytes)?;
        let sets = self.fair.sets(region);
        let mut goal = BitSet::new(states, false);
        (0..states as u32).filter(|it| sets.has(*it)).for_each(|it| goal.insert(it));
        drop(sets);
        self.memory.release(bytes);
        let ranks = self.backward(&goal, region)?;
        self.memory.release(4 * states as u64);
        for (state, _) in (0..).zip(&ranks).filter(|it| *it.1 != u32::MAX) {
            goal.insert(state);
        }
        Ok(goal)
    }

    pub(super) fn sets(&self, region: &BitSet) -> FairSets {
        self.fair.sets(region)
    }

    /// For each state how many firings through such states a goal is away; `u32::MAX` when none is
    /// reached.
    fn backward(&mut self, goal: &BitSet, through: &BitSet) -> Result<Vec<u32>, Limit> {
        let graph = self.graph;
        self.memory.take(4 * graph.states() as u64)?;
        if self.before.is_none() {
            self.memory.take(Predecessors::bytes(graph))?;
        }
        let before = &*self.before.get_or_insert_with(|| Predecessors::new(graph));
        let rank_of = |it: u32| AtomicU32::new(if goal.has(it) { 0 } else { u32::MAX });
        let ranks: Vec<AtomicU32> = (0..graph.states() as u32).map(rank_of).collect();
        let mut level: Vec<u32> = goal.ones().collect();
        let mut rank = 0;
        while !level.is_empty() {
            rank += 1;
            // Which thread meets a state first is left to chance, its rank is not.
            let further = |states: &[u32]| {
                let mut next = Vec::new();
                for &from in states.iter().flat_map(|it| before.of(*it)) {
                    let found = &ranks[from as usize];
                    if found.load(Relaxed) == u32::MAX
                        && through.has(from)
                        && found.compare_exchange(u32::MAX, rank, Relaxed, Relaxed).is_ok()
                    {
                        next.push(from);
                    }
                }
                next
            };
            level = in_parts(&level, self.jobs, &further);
        }
        Ok(ranks.into_iter().map(AtomicU32::into_inner).collect())
    }
}

/// States that are worth a thread of their own.
const WORTH: usize = 1 << 13;

/// What follows from the states of a level, looked at by so many threads.
fn in_parts(
    level: &[u32],
    jobs: usize,
    further: &(impl Fn(&[u32]) -> Vec<u32> + Sync),
) -> Vec<u32> {
    let jobs = jobs.clamp(1, level.len().div_ceil(WORTH).max(1));
    let mut parts = level.chunks(level.len().div_ceil(jobs).max(1));
    let first = parts.next().unwrap_or_default();
    if parts.len() == 0 {
        return further(first);
    }
    thread::scope(|scope| {
        let others: Vec<_> = parts.map(|it| scope.spawn(move || further(it))).collect();
        let mut next = further(first);
        for other in others {
            next.extend(other.join().unwrap_or_else(|it| resume_unwind(it)));
        }
        next
    })
}

/// For each state those that it follows.
struct Predecessors {
    starts: Vec<u32>,
    states: Vec<u32>,
}

impl Predecessors {
    fn bytes(graph: &impl Successors) -> u64 {
        if u32::try_from(graph.arcs()).is_err() {
            return u64::MAX / 2; // positions are numbers of 32 bits
        }
        4 * (2 * graph.states() as u64 + graph.arcs() as u64)
    }

    fn new(graph: &impl Successors) -> Self {
        let count = graph.states();
        let mut starts = vec![0_u32; count + 1];
        for from in 0..count as u32 {
            graph.successors(from).iter().for_each(|it| starts[*it as usize + 1] += 1);
        }
        for at in 0..count {
            starts[at + 1] += starts[at];
        }
        let (mut ends, mut states) = (starts.clone(), vec![0; graph.arcs()]);
        for from in 0..count as u32 {
            for &to in graph.successors(from) {
                let end = &mut ends[to as usize];
                states[*end as usize] = from;
                *end += 1;
            }
        }
        Self { starts, states }
    }

    fn of(&self, state: u32) -> &[u32] {
        &self.states[self.starts[state as usize] as usize..self.starts[state as usize + 1] as usize]
    }
}
