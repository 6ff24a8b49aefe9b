//! Which runs count.

use super::successors::Successors;
use crate::components::{Digraph, Search};
use crate::explicit::{BitSet, Goal, Limit, Memory};
use cotama_core::net::TransitionId;
use cotama_property::run::Rest;
use cotama_property::{Assumptions, Atom, Formula};
use std::collections::VecDeque;
use std::ops::ControlFlow;

/// A fairness constraint on runs; runs that violate it are left out. A run that ends in a deadlock
/// stays there for ever.
#[derive(Clone, Debug, Default)]
pub struct Fairness<'f> {
    /// Each of these holds again and again.
    pub recurring: Vec<Goal<'f>>,
    /// Each of these is disabled again and again, or fires again and again: none is enabled for
    /// ever from some time on without firing.
    pub weak: Vec<TransitionId>,
    /// Each of these, if it is enabled again and again, fires again and again.
    pub strong: Vec<TransitionId>,
}

impl<'f> Fairness<'f> {
    /// Returns the fairness of assumptions; `None` when a formula that is to hold often speaks of
    /// more than one marking.
    pub fn of(assumed: &'f Assumptions) -> Option<Self> {
        let recurring = assumed.often.iter().map(Goal::new).collect::<Option<_>>()?;
        Some(Self { recurring, weak: assumed.weak.clone(), strong: assumed.strong.clone() })
    }

    /// Whether all runs are fair.
    pub fn is_none(&self) -> bool {
        self.recurring.is_empty() && self.weak.is_empty() && self.strong.is_empty()
    }
}

/// No state.
const NONE: u32 = u32::MAX;

/// Fairness on the states of a graph.
pub(super) struct Fair<'g, S> {
    graph: &'g S,
    recurring: Vec<BitSet>,
    treated: Vec<Treated>,
}

/// A transition that is treated fairly.
struct Treated {
    transition: TransitionId,
    is_strong: bool,
    /// The states that enable it.
    enabled: BitSet,
    /// For each state where the states begin that it leads to, and where the last ones end.
    starts: Vec<u32>,
    to: Vec<u32>,
}

impl Treated {
    fn of(&self, state: u32) -> &[u32] {
        &self.to[self.starts[state as usize] as usize..self.starts[state as usize + 1] as usize]
    }
}

/// Sets of states in each of which a fair run can stay, going everywhere.
pub(super) struct FairSets {
    /// For each state its set; [`NONE`] in no set.
    of: Vec<u32>,
}

impl FairSets {
    pub(super) fn has(&self, state: u32) -> bool {
        self.of[state as usize] != NONE
    }
}

impl<'g, S: Successors> Fair<'g, S> {
    pub(super) fn new(
        graph: &'g S,
        fairness: &Fairness<'_>,
        memory: &mut Memory,
        jobs: usize,
    ) -> Result<Self, Limit> {
        let states = graph.states();
        let weak = fairness.weak.iter().map(|it| (*it, false));
        let strong = fairness.strong.iter().map(|it| (*it, true));
        let mut treated = Vec::new();
        for (transition, is_strong) in weak.chain(strong) {
            memory.take(BitSet::bytes(states) + 4 * states as u64)?;
            let fireable = Formula::Atom(Atom::Fireable(vec![transition]));
            let enabled = Goal::new(&fireable).map(|it| graph.satisfying(it, jobs));
            let enabled = enabled.unwrap_or_else(|| BitSet::new(states, false));
            let starts = Vec::with_capacity(states + 1);
            treated.push(Treated { transition, is_strong, enabled, starts, to: Vec::new() });
        }
        if !treated.is_empty() {
            for state in 0..states as u32 {
                let arcs = graph.transitions(state);
                for it in &mut treated {
                    it.starts.push(it.to.len() as u32);
                    let first = arcs.partition_point(|other| *other < it.transition);
                    let same = arcs[first..].iter().take_while(|other| **other == it.transition);
                    let count = same.count();
                    memory.room(&mut it.to, count)?;
                    it.to.extend(&graph.successors(state)[first..first + count]);
                }
            }
            treated.iter_mut().for_each(|it| it.starts.push(it.to.len() as u32));
        }
        let mut recurring = Vec::new();
        for goal in &fairness.recurring {
            memory.take(BitSet::bytes(states))?;
            recurring.push(graph.satisfying(*goal, jobs));
        }
        Ok(Self { graph, recurring, treated })
    }

    /// The fair sets inside of a region. Those of different numbers are disjoint, and every fair
    /// run that stays in the region is in one of them from some time on.
    pub(super) fn sets(&self, region: &BitSet) -> FairSets {
        let mut of = vec![NONE; region.len()];
        // The region that a state is in; NONE in none of those that are still looked at.
        let mut part: Vec<u32> = region.iter().map(|it| if it { 0 } else { NONE }).collect();
        let first: Vec<u32> = region.ones().collect();
        let (mut work, mut parts, mut sets) = (vec![first], 1, 0);
        let mut search = Search::new(region.len());
        while let Some(states) = work.pop() {
            for component in Part::components(self.graph, &states, &part, &mut search) {
                for state in &component {
                    part[*state as usize] = parts;
                }
                parts += 1;
                match self.verdict(&component, &part) {
                    None => component.iter().for_each(|it| part[*it as usize] = NONE),
                    Some(removed) if removed.is_empty() => {
                        for it in component {
                            of[it as usize] = sets;
                        }
                        sets += 1;
                    }
                    Some(removed) => {
                        for it in removed {
                            part[it as usize] = NONE;
                        }
                        let rest = component.into_iter().filter(|it| part[*it as usize] != NONE);
                        work.push(rest.collect());
                    }
                }
            }
        }
        FairSets { of }
    }

    /// For an SCC: `None` if it has no fair run, else the states to remove to make it fair (empty
    /// if it is fair).
    fn verdict(&self, component: &[u32], part: &[u32]) -> Option<Vec<u32>> {
        let first = *component.first()?;
        let is_inside = |to: u32| part[to as usize] == part[first as usize];
        let successors = self.graph.successors(first);
        if component.len() == 1 && !successors.is_empty() && !successors.contains(&first) {
            return None;
        }
        let some = |holds: &dyn Fn(u32) -> bool| component.iter().any(|it| holds(*it));
        if !self.recurring.iter().all(|it| some(&|state| it.has(state))) {
            return None;
        }
        let mut removed = Vec::new();
        for it in &self.treated {
            if some(&|state| it.of(state).iter().any(|to| is_inside(*to))) {
                continue;
            }
            if it.is_strong {
                removed.extend(component.iter().filter(|state| it.enabled.has(**state)));
            } else if !some(&|state| !it.enabled.has(state)) {
                return None;
            }
        }
        Some(removed)
    }

    /// A fair run from a state that goes through a region, all of whose states lead to a fair set
    /// in it: what is fired first, and what then.
    pub(super) fn run(
        &self,
        from: u32,
        region: &BitSet,
        sets: &FairSets,
    ) -> (Vec<TransitionId>, Rest) {
        let mut stem = Vec::new();
        let mut first = from;
        if !sets.has(first) {
            let is_last = |_, to: u32, _: usize| sets.has(to);
            let Some(path) = self.path(first, &|it| region.has(it), is_last) else {
                return (stem, Rest::Any);
            };
            (stem, first) = path;
        }
        if self.graph.successors(first).is_empty() {
            return (stem, Rest::Stays);
        }
        let set = sets.of[first as usize];
        let inside = |it: u32| sets.of[it as usize] == set;
        let (mut cycle, mut at) = (Vec::new(), first);
        let mut met = vec![first];
        let mut go = |cycle: &mut Vec<TransitionId>,
                      at: &mut u32,
                      is_last: &dyn Fn(u32, u32, usize) -> bool| {
            if let Some((path, to)) = self.path(*at, &inside, is_last) {
                cycle.extend(path);
                *at = to;
                met.push(to);
            }
        };
        for holds in &self.recurring {
            if !holds.has(at) {
                go(&mut cycle, &mut at, &|_, to, _| holds.has(to));
            }
        }
        for it in &self.treated {
            let mut members = (0..sets.of.len() as u32).filter(|it| inside(*it));
            if members.any(|state| it.of(state).iter().any(|to| inside(*to))) {
                let fires =
                    |from: u32, _, arc: usize| self.graph.transitions(from)[arc] == it.transition;
                go(&mut cycle, &mut at, &fires);
            } else if !it.is_strong && it.enabled.has(at) {
                go(&mut cycle, &mut at, &|_, to, _| !it.enabled.has(to));
            }
        }
        if at != first || cycle.is_empty() {
            go(&mut cycle, &mut at, &|_, to, _| to == first);
        }
        (stem, Rest::Cycle(cycle))
    }

    /// A shortest path of at least one step through such states up to and with a step that is the
    /// last one (from, to, position of the arc), and where it leads.
    fn path(
        &self,
        from: u32,
        inside: &dyn Fn(u32) -> bool,
        is_last: impl Fn(u32, u32, usize) -> bool,
    ) -> Option<(Vec<TransitionId>, u32)> {
        let mut before: Vec<(u32, u32)> = vec![(NONE, 0); self.graph.states()];
        let mut queue = VecDeque::from([from]);
        while let Some(state) = queue.pop_front() {
            for (arc, &to) in
                self.graph.successors(state).iter().enumerate().filter(|it| inside(*it.1))
            {
                if is_last(state, to, arc) {
                    let fired = |state: u32, arc: usize| self.graph.transitions(state)[arc];
                    let (mut path, mut at) = (vec![fired(state, arc)], state);
                    while at != from {
                        let (earlier, arc) = before[at as usize];
                        path.push(fired(earlier, arc as usize));
                        at = earlier;
                    }
                    path.reverse();
                    return Some((path, to));
                }
                if to != from && before[to as usize].0 == NONE {
                    before[to as usize] = (state, arc as u32);
                    queue.push_back(to);
                }
            }
        }
        None
    }
}

/// A part of a graph, and its strongly connected components so far.
struct Part<'p, S> {
    graph: &'p S,
    of: &'p [u32],
    number: u32,
    components: Vec<Vec<u32>>,
}

impl<'p, S: Successors> Part<'p, S> {
    /// The components of the states of one part.
    fn components(
        graph: &'p S,
        states: &[u32],
        of: &'p [u32],
        search: &mut Search,
    ) -> Vec<Vec<u32>> {
        let number = states.first().map_or(NONE, |it| of[*it as usize]);
        let mut part = Self { graph, of, number, components: Vec::new() };
        search.forget(states);
        for state in states {
            if search.pass(&mut part, *state).is_break() {
                break;
            }
        }
        part.components
    }
}

impl<S: Successors> Digraph for Part<'_, S> {
    fn successor(&mut self, state: u32, at: u32) -> Option<u32> {
        let to = *self.graph.successors(state).get(at as usize)?;
        // An arc that leaves the part counts as one to the state itself, which joins nothing.
        Some(if self.of[to as usize] == self.number { to } else { state })
    }

    fn component(&mut self, members: &[u32]) -> ControlFlow<()> {
        self.components.push(members.to_vec());
        ControlFlow::Continue(())
    }
}
