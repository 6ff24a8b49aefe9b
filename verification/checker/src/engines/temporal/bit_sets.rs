//! Sets of the states of a graph as bit vectors.

use super::fairness::{Fair, FairSets, Fairness};
use super::state_sets::StateSets;
use super::successors::Successors;
use crate::explicit::{BitSet, Goal, Limit, Memory};
use cotama_property::Formula;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::thread;

/// Sets of states of a graph as bit vectors, with the fair runs in it.
pub struct BitSets<'g, S> {
    pub(super) graph: &'g S,
    pub(super) fair: Fair<'g, S>,
    /// States from which some fair run goes; `None` when all runs are fair.
    pub(super) fair_states: Option<BitSet>,
    before: Option<Predecessors>,
    memory: Memory,
    jobs: usize,
}

impl<'g, S: Successors> BitSets<'g, S> {
    /// All about fairness that is asked again and again, in at most so many bytes.
    ///
    /// # Errors
    /// [`Limit::Bytes`] when they are not enough.
    pub fn new(
        graph: &'g S,
        fairness: &Fairness<'g>,
        bytes: u64,
        jobs: usize,
    ) -> Result<Self, Limit> {
        let mut memory = Memory::new(bytes);
        let fair = Fair::new(graph, fairness, &mut memory, jobs)?;
        let mut sets = Self { graph, fair, fair_states: None, before: None, memory, jobs };
        if !fairness.is_none() {
            let all = BitSet::new(graph.states(), true);
            sets.fair_states = Some(sets.always(&all)?);
        }
        Ok(sets)
    }

    /// The sets in each of which a fair run can stay.
    pub(super) fn fair_sets(&self, region: &BitSet) -> FairSets {
        self.fair.sets(region)
    }

    fn set(&mut self, all: bool) -> Result<BitSet, Limit> {
        let states = self.graph.states();
        self.memory.take(BitSet::bytes(states))?;
        Ok(BitSet::new(states, all))
    }

    fn fair_and(&self, set: &BitSet) -> BitSet {
        let mut holds = set.clone();
        if let Some(fair) = &self.fair_states {
            holds.and(fair);
        }
        holds
    }

    /// For each state how many firings through such states a goal is away; `u32::MAX` when none is
    /// reached.
    fn backward(&mut self, goal: &BitSet, through: &BitSet) -> Result<Vec<u32>, Limit> {
        let graph = self.graph;
        debug_assert_eq!((goal.len(), through.len()), (graph.states(), graph.states()));
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

impl<S: Successors> StateSets for BitSets<'_, S> {
    type Set = BitSet;
    /// For each state how many firings the goal is away; `u32::MAX` where none is reached.
    type Ranks = Vec<u32>;

    fn all(&mut self, is_full: bool) -> Result<BitSet, Limit> {
        self.set(is_full)
    }

    fn satisfying(&mut self, formula: &Formula) -> Result<BitSet, Limit> {
        let set = self.set(false)?;
        let (graph, jobs) = (self.graph, self.jobs);
        Ok(Goal::new(formula).map_or(set, |goal| graph.satisfying(goal, jobs)))
    }

    fn complement(&mut self, set: &BitSet) -> Result<BitSet, Limit> {
        self.memory.take(BitSet::bytes(set.len()))?;
        Ok(set.complement())
    }

    fn and(&mut self, set: &mut BitSet, other: &BitSet) {
        set.and(other);
    }

    fn or(&mut self, set: &mut BitSet, other: &BitSet) {
        set.or(other);
    }

    fn before(&mut self, goal: &BitSet) -> Result<BitSet, Limit> {
        let goal = self.fair_and(goal);
        let mut holds = self.set(false)?;
        for state in 0..self.graph.states() as u32 {
            if self.graph.successors(state).iter().any(|it| goal.has(*it)) {
                holds.insert(state);
            }
        }
        Ok(holds)
    }

    fn until(&mut self, through: &BitSet, goal: &BitSet) -> Result<(BitSet, Vec<u32>), Limit> {
        let mut holds = self.set(false)?;
        let bytes = BitSet::bytes(goal.len());
        self.memory.take(bytes)?;
        let goal = self.fair_and(goal);
        let ranks = self.backward(&goal, through)?;
        self.memory.release(bytes);
        for (state, _) in (0..).zip(&ranks).filter(|it| *it.1 != u32::MAX) {
            holds.insert(state);
        }
        Ok((holds, ranks))
    }

    fn always(&mut self, region: &BitSet) -> Result<BitSet, Limit> {
        let states = self.graph.states();
        let mut goal = self.set(false)?;
        // Lists of the search for components, which are given back.
        let bytes = 24 * states as u64;
        self.memory.take(bytes)?;
        let sets = self.fair.sets(region);
        (0..states as u32).filter(|it| sets.has(*it)).for_each(|it| goal.insert(it));
        drop(sets);
        self.memory.release(bytes);
        debug_assert!(goal.ones().all(|it| region.has(it)), "fair runs stay in the region");
        let ranks = self.backward(&goal, region)?;
        self.memory.release(4 * states as u64);
        for (state, _) in (0..).zip(&ranks).filter(|it| *it.1 != u32::MAX) {
            goal.insert(state);
        }
        Ok(goal)
    }

    fn has_first(&self, set: &BitSet) -> bool {
        set.has(0)
    }

    fn is_empty(&self, set: &BitSet) -> bool {
        set.ones().next().is_none()
    }
}

/// States that are worth a thread of their own.
const WORTH: usize = 1 << 13;

/// Applies a function to the states of a level with so many threads, and joins the results.
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
        debug_assert_eq!(starts[count] as usize, graph.arcs(), "each arc goes to a state");
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
