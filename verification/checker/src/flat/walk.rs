//! Walks through the graph of a system that acts in rounds.

use super::path::Part;
use super::rounds::Rounds;
use crate::explicit::{Goal, Graph};
use cotama_core::net::{PlaceId, TransitionId};
use std::collections::VecDeque;

/// How large a system is that acts in rounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Size {
    /// Markings between two rounds.
    pub states: u64,
    /// Pairs of such a marking and what can come from outside in the round after it, nothing among
    /// it.
    pub edges: u64,
}

/// The events of a round.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Happened {
    /// The transitions fired and the events ignored in each turn, in order.
    pub turns: Vec<String>,
    /// The event from outside and what fired because of it; `None` when the round is not over.
    pub outside: Option<(Option<String>, String)>,
}

impl Rounds {
    /// Counts rounds in the graph of the net.
    pub fn size(&self, graph: &Graph) -> Size {
        let mut size = Size::default();
        let marked = |place: PlaceId| graph.tokens(place).map(|it| it > 0).collect::<Vec<_>>();
        let (round, outside) = (marked(self.round), marked(self.outside));
        for state in (0..graph.states() as u32).filter(|&it| round[it as usize]) {
            let mut at = state;
            while !outside[at as usize] {
                // Until then one transition is enabled in each marking, and none twice.
                let Some(&next) = graph.successors(at).first() else { break };
                at = next;
            }
            size.states += 1;
            size.edges += graph.successors(at).len() as u64;
        }
        size
    }

    /// A path to a marking with the fewest rounds, and of these with the fewest firings.
    pub fn path(&self, graph: &Graph, goal: Goal<'_>) -> Option<Vec<TransitionId>> {
        let goal = graph.satisfying(goal, 1);
        let mut before: Vec<Option<(u32, TransitionId)>> = vec![None; graph.states()];
        let (mut far, mut done) = (vec![u32::MAX; graph.states()], vec![false; graph.states()]);
        let mut next = VecDeque::from([0_u32]);
        far[0] = 0;
        while let Some(state) = next.pop_front() {
            if std::mem::replace(&mut done[state as usize], true) {
                continue;
            }
            if goal[state as usize] {
                let (mut way, mut at) = (Vec::new(), state);
                while let Some((from, transition)) = before[at as usize] {
                    way.push(transition);
                    at = from;
                }
                way.reverse();
                return Some(way);
            }
            for (transition, &after) in
                graph.transitions(state).into_iter().zip(graph.successors(state))
            {
                let ends = self.part(transition) == Some(Part::Outside);
                let rounds = far[state as usize] + u32::from(ends);
                if rounds < far[after as usize] {
                    far[after as usize] = rounds;
                    before[after as usize] = Some((state, transition));
                    if ends { next.push_back(after) } else { next.push_front(after) }
                }
            }
        }
        None
    }

    /// Returns the events of each round of a run.
    pub fn told(&self, run: &[TransitionId]) -> Vec<Happened> {
        let mut rounds: Vec<Happened> = Vec::new();
        let mut is_over = true;
        for path in run.iter().filter_map(|it| self.paths.get(it.0 as usize)) {
            if is_over {
                rounds.push(Happened::default());
            }
            let Some(round) = rounds.last_mut() else { continue };
            is_over = path.change.get(&self.round) == Some(&1);
            match path.part {
                Part::Between => {}
                Part::Turn => round.turns.push(path.name.clone()),
                Part::Outside => {
                    let event = path.on.and_then(|it| self.draft.events.get(it.0 as usize));
                    round.outside = Some((event.map(|it| it.name.clone()), path.name.clone()));
                }
            }
        }
        rounds
    }
}
