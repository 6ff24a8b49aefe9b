//! Which runs count.

use super::run::Rest;
use crate::explicit::{Goal, Graph};
use crate::property::Assumptions;
use cotama_core::net::TransitionId;
use std::collections::VecDeque;

/// What is asked of runs; one that does not meet all of it is left out. A run that ends in a
/// deadlock stays there for ever.
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
    /// That of assumptions; `None` when what is to hold often speaks of more than one marking.
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
pub(super) struct Fair<'g> {
    graph: &'g Graph,
    recurring: Vec<Vec<bool>>,
    /// For each of these transitions and each state where it leads, [`NONE`] where it is disabled;
    /// and whether it is to be treated strongly fair.
    targets: Vec<(TransitionId, bool, Vec<u32>)>,
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

impl<'g> Fair<'g> {
    pub(super) fn new(graph: &'g Graph, fairness: &Fairness<'_>) -> Self {
        let states = graph.states();
        let weak = fairness.weak.iter().map(|it| (*it, false, vec![NONE; states]));
        let strong = fairness.strong.iter().map(|it| (*it, true, vec![NONE; states]));
        let mut targets: Vec<_> = weak.chain(strong).collect();
        if !targets.is_empty() {
            for state in 0..states as u32 {
                let arcs = graph.transitions(state);
                for (transition, _, to) in &mut targets {
                    if let Ok(at) = arcs.binary_search(transition) {
                        to[state as usize] = graph.successors(state)[at];
                    }
                }
            }
        }
        Self {
            graph,
            recurring: fairness.recurring.iter().map(|it| graph.satisfying(*it)).collect(),
            targets,
        }
    }

    /// The fair sets inside of a region. Those of different numbers are disjoint, and every fair
    /// run that stays in the region is in one of them from some time on.
    pub(super) fn sets(&self, region: &[bool]) -> FairSets {
        let mut of = vec![NONE; region.len()];
        // The region that a state is in; NONE in none of those that are still looked at.
        let mut part: Vec<u32> = region.iter().map(|it| if *it { 0 } else { NONE }).collect();
        let first: Vec<u32> = (0..region.len() as u32).filter(|it| region[*it as usize]).collect();
        let (mut work, mut parts, mut sets) = (vec![first], 1, 0);
        let mut low = vec![0; region.len()];
        while let Some(states) = work.pop() {
            for component in components(self.graph, &states, &part, &mut low) {
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

    /// Of a strongly connected set: `None` when no fair run stays in it; else the states that a
    /// fair run in it does without, none when it is fair as it is.
    fn verdict(&self, component: &[u32], part: &[u32]) -> Option<Vec<u32>> {
        let first = *component.first()?;
        let is_inside = |to: u32| to != NONE && part[to as usize] == part[first as usize];
        let successors = self.graph.successors(first);
        if component.len() == 1 && !successors.is_empty() && !successors.contains(&first) {
            return None;
        }
        let some = |holds: &dyn Fn(usize) -> bool| component.iter().any(|it| holds(*it as usize));
        if !self.recurring.iter().all(|it| some(&|state| it[state])) {
            return None;
        }
        let mut removed = Vec::new();
        for (_, is_strong, to) in &self.targets {
            if some(&|state| is_inside(to[state])) {
                continue;
            }
            if *is_strong {
                removed.extend(component.iter().filter(|it| to[**it as usize] != NONE));
            } else if !some(&|state| to[state] == NONE) {
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
        region: &[bool],
        sets: &FairSets,
    ) -> (Vec<TransitionId>, Rest) {
        let mut stem = Vec::new();
        let mut first = from;
        if !sets.has(first) {
            let is_last = |_, to: u32, _: usize| sets.has(to);
            let Some(way) = self.way(first, &|it| region[it as usize], is_last) else {
                return (stem, Rest::Any);
            };
            (stem, first) = way;
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
            if let Some((way, to)) = self.way(*at, &inside, is_last) {
                cycle.extend(way);
                *at = to;
                met.push(to);
            }
        };
        for holds in &self.recurring {
            if !holds[at as usize] {
                go(&mut cycle, &mut at, &|_, to, _| holds[to as usize]);
            }
        }
        for (transition, is_strong, to) in &self.targets {
            let members = || (0..sets.of.len()).filter(|it| sets.of[*it] == set);
            if members().any(|it| to[it] != NONE && inside(to[it])) {
                let fires =
                    |from: u32, _, arc: usize| self.graph.transitions(from)[arc] == *transition;
                go(&mut cycle, &mut at, &fires);
            } else if !is_strong && to[at as usize] != NONE {
                go(&mut cycle, &mut at, &|_, it, _| to[it as usize] == NONE);
            }
        }
        if at != first || cycle.is_empty() {
            go(&mut cycle, &mut at, &|_, to, _| to == first);
        }
        (stem, Rest::Cycle(cycle))
    }

    /// A shortest way of at least one step through such states up to and with a step that is the
    /// last one (from, to, position of the arc), and where it leads.
    fn way(
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
                    let (mut way, mut at) = (vec![fired(state, arc)], state);
                    while at != from {
                        let (earlier, arc) = before[at as usize];
                        way.push(fired(earlier, arc as usize));
                        at = earlier;
                    }
                    way.reverse();
                    return Some((way, to));
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

/// The strongly connected components of some states, by arcs inside of their part. `low` is room
/// for numbers.
fn components(graph: &Graph, states: &[u32], part: &[u32], low: &mut [u32]) -> Vec<Vec<u32>> {
    // Numbers in the order in which states are met; NONE for those that are left.
    for it in states {
        low[*it as usize] = 0;
    }
    let (mut found, mut waiting, mut met) = (Vec::new(), Vec::new(), 0);
    let mut visits: Vec<(u32, usize, u32)> = Vec::new();
    for &root in states {
        if low[root as usize] != 0 {
            continue;
        }
        met += 1;
        low[root as usize] = met;
        waiting.push(root);
        visits.push((root, 0, met));
        let mine = part[root as usize];
        while let Some((state, next, number)) = visits.last_mut() {
            let (state, number) = (*state, *number);
            if let Some(&to) = graph.successors(state).get(*next) {
                *next += 1;
                // Parts that were numbered anew are components that are left.
                if part[to as usize] != mine {
                    continue;
                }
                if low[to as usize] == 0 {
                    met += 1;
                    low[to as usize] = met;
                    waiting.push(to);
                    visits.push((to, 0, met));
                } else if low[to as usize] != NONE {
                    low[state as usize] = low[state as usize].min(low[to as usize]);
                }
                continue;
            }
            visits.pop();
            let lowest = low[state as usize];
            if lowest == number {
                let from = waiting.iter().rposition(|it| *it == state).unwrap_or(0);
                let component: Vec<u32> = waiting.drain(from..).collect();
                for it in &component {
                    low[*it as usize] = NONE;
                }
                found.push(component);
            } else if let Some((before, ..)) = visits.last() {
                low[*before as usize] = low[*before as usize].min(lowest);
            }
        }
    }
    found
}
