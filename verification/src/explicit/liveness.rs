//! What can always happen again.

use super::graph::Graph;
use cotama_core::net::TransitionId;

/// Which transitions can fire once, which always again, and whether the net can always return to
/// the start.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::explicit::{Graph, Limits};
/// use cotama_verification::pt::Pt;
/// let graph = Graph::new(&Pt::from(&door::NET), &Limits::default(), &|_| {}).unwrap();
/// let liveness = graph.liveness();
/// assert!(liveness.is_live() && liveness.reversible);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Liveness {
    /// Transitions that can fire from every reachable marking, at once or later.
    pub live: Vec<TransitionId>,
    /// Transitions that can fire from some reachable marking, and no more from another one.
    pub mortal: Vec<TransitionId>,
    /// Transitions that can never fire.
    pub dead: Vec<TransitionId>,
    /// Whether the initial marking can be reached from every reachable marking.
    pub reversible: bool,
    /// Markings that can be reached from every reachable marking: home markings.
    pub home: u64,
}

impl Liveness {
    /// Whether every transition can fire from every reachable marking, at once or later.
    pub fn is_live(&self) -> bool {
        self.mortal.is_empty() && self.dead.is_empty()
    }

    /// Whether every transition can fire.
    pub fn is_quasi_live(&self) -> bool {
        self.dead.is_empty()
    }
}

/// The strongly connected components of a [`Graph`]: sets of markings that can all be reached from
/// each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// For each marking its component. Arcs lead to components with smaller numbers, or stay.
    pub of: Vec<u32>,
    /// How many components there are.
    pub count: u32,
}

impl Graph {
    /// Its strongly connected components.
    ///
    /// They are those of D. J. Pearce, *A space-efficient algorithm for finding strongly connected
    /// components*, Information Processing Letters 116 (2016), without recursion.
    pub fn components(&self) -> Components {
        let states = self.states() as u32;
        // Zero for a marking that was not met; for one that is under way the least that it leads
        // back to, as numbers in the order in which they were met; for others `states` minus the
        // number of the component, which is never less.
        let mut ranks = vec![0_u32; states as usize];
        let (mut rank, mut count) = (1, 0);
        // Markings that are left, and wait for the one that they lead back to.
        let mut waiting: Vec<u32> = Vec::new();
        let mut visits: Vec<Visit> = Vec::new();
        // The initial marking leads to all others.
        ranks[0] = rank;
        rank += 1;
        visits.push(Visit { state: 0, next: 0, rank: 1 });
        while let Some(visit) = visits.last_mut() {
            let state = visit.state;
            if let Some(&to) = self.successors(state).get(visit.next as usize) {
                if ranks[to as usize] == 0 {
                    ranks[to as usize] = rank;
                    visits.push(Visit { state: to, next: 0, rank });
                    rank += 1;
                    continue;
                }
                visit.next += 1;
                ranks[state as usize] = ranks[state as usize].min(ranks[to as usize]);
                continue;
            }
            if ranks[state as usize] == visit.rank {
                // It leads back to none before it: those that wait for it are its component.
                let first = visit.rank;
                rank -= 1;
                while let Some(member) = waiting.pop_if(|it| ranks[*it as usize] >= first) {
                    ranks[member as usize] = states - count;
                    rank -= 1;
                }
                ranks[state as usize] = states - count;
                count += 1;
            } else {
                waiting.push(state);
            }
            visits.pop();
        }
        for it in &mut ranks {
            *it = states - *it;
        }
        Components { of: ranks, count }
    }

    /// What can always happen again.
    pub fn liveness(&self) -> Liveness {
        let Components { of, count } = self.components();
        let states = || 0..self.states() as u32;
        let mut is_final = vec![true; count as usize];
        for state in states() {
            let component = of[state as usize];
            is_final[component as usize] &=
                self.successors(state).iter().all(|it| of[*it as usize] == component);
        }
        let mut last: Vec<u32> =
            states().filter(|it| is_final[of[*it as usize] as usize]).collect();
        last.sort_by_key(|it| of[*it as usize]);
        let mut live: Vec<u32> = self.fired(true).collect();
        for component in last.chunk_by(|a, b| of[*a as usize] == of[*b as usize]) {
            let enabled = self.enabled(component.iter().copied());
            live.retain(|it| enabled[*it as usize / 64] >> (it % 64) & 1 == 1);
        }
        let mortal = self
            .fired(true)
            .filter(|it| live.binary_search(it).is_err())
            .map(TransitionId)
            .collect();
        let is_home = is_final.iter().filter(|it| **it).count() == 1;
        Liveness {
            live: live.into_iter().map(TransitionId).collect(),
            mortal,
            dead: self.fired(false).map(TransitionId).collect(),
            reversible: count == 1,
            home: if is_home { last.len() as u64 } else { 0 },
        }
    }
}

/// A marking that is being visited.
#[derive(Debug)]
struct Visit {
    state: u32,
    /// Its next successor.
    next: u32,
    /// When it was met.
    rank: u32,
}
