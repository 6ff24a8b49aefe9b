//! Liveness: the transitions that can always fire again.

use super::graph::Graph;
use crate::components::{Components, components};
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

impl Graph {
    /// Returns the strongly connected components: sets of markings that can all be reached from
    /// each other.
    pub fn components(&self) -> Components {
        components(self.states(), |state, at| self.successors(state).get(at as usize).copied())
    }

    /// Returns the liveness of transitions and of the initial marking.
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
