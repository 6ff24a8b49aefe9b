//! One run that shows why a formula of CTL holds, or does not.

use super::bit_sets::BitSets;
use super::labelling::Labelling;
use super::successors::Successors;
use crate::explicit::BitSet;
use cotama_core::net::TransitionId;
use cotama_property::CtlNode;
use cotama_property::run::{Rest, Run};

/// A run as evidence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Witness {
    /// The run: a counterexample when the verdict is no.
    pub run: Run,
    /// Whether it suffices; otherwise where it ends something is left to show that takes more than
    /// one run.
    pub is_complete: bool,
}

/// A run from the initial marking that shows the verdict; `None` when no run is needed, or when
/// none can begin to show it.
pub(super) fn explained<S: Successors>(
    labelling: &Labelling<'_, BitSets<'_, S>>,
    verdict: bool,
) -> Option<Witness> {
    let mut path = Path { labelling, state: 0, fired: Vec::new(), rest: Rest::Any, has_run: false };
    let is_complete = path.show(labelling.formula.root(), verdict);
    if !path.has_run {
        return None;
    }
    if path.rest == Rest::Any
        && let Some(fair) = &labelling.sets.fair_states
    {
        path.go_on(fair);
    }
    let run = match path.rest {
        Rest::Cycle(cycle) => Run::lasso(path.fired, cycle, labelling.sets.graph.is_injective()),
        rest => Run { stem: path.fired, rest },
    };
    Some(Witness { run, is_complete })
}

struct Path<'l, 'f, 'g, S: Successors> {
    labelling: &'l Labelling<'f, BitSets<'g, S>>,
    state: u32,
    fired: Vec<TransitionId>,
    rest: Rest,
    has_run: bool,
}

impl<S: Successors> Path<'_, '_, '_, S> {
    fn node(&self, at: u32) -> &CtlNode {
        &self.labelling.formula.nodes()[at as usize]
    }

    /// Whether a part holds here; parts that were not looked at do not matter.
    fn holds(&self, node: u32) -> Option<bool> {
        if let Some(label) = &self.labelling.labels[node as usize] {
            return Some(label.has(self.state));
        }
        let of = |it: &u32| self.holds(*it);
        match self.node(node) {
            CtlNode::Not(a) => of(a).map(|it| !it),
            CtlNode::And(all) if all.iter().any(|it| of(it) == Some(false)) => Some(false),
            CtlNode::And(all) => all.iter().all(|it| of(it) == Some(true)).then_some(true),
            CtlNode::Or(all) if all.iter().any(|it| of(it) == Some(true)) => Some(true),
            CtlNode::Or(all) => all.iter().all(|it| of(it) == Some(false)).then_some(false),
            _ => None,
        }
    }

    /// Whether a part speaks of one marking only.
    fn is_state(&self, node: u32) -> bool {
        match self.node(node) {
            CtlNode::State(_) => true,
            CtlNode::Not(a) => self.is_state(*a),
            CtlNode::And(all) | CtlNode::Or(all) => all.iter().all(|it| self.is_state(*it)),
            _ => false,
        }
    }

    /// Extends the run to show that a part holds here, or does not; whether that is all there is to
    /// show.
    fn show(&mut self, node: u32, value: bool) -> bool {
        if self.is_state(node) {
            return true;
        }
        let graph = self.labelling.sets.graph;
        match (self.node(node).clone(), value) {
            (CtlNode::State(_), _) => true,
            (CtlNode::Not(a), _) => self.show(a, !value),
            (CtlNode::And(all), true) | (CtlNode::Or(all), false) => {
                let open: Vec<u32> = all.into_iter().filter(|it| !self.is_state(*it)).collect();
                let run = open.iter().copied().find(|it| self.is_run(*it, value));
                let is_shown =
                    run.or_else(|| open.first().copied()).is_none_or(|it| self.show(it, value));
                open.len() < 2 && is_shown
            }
            (CtlNode::And(all) | CtlNode::Or(all), _) => {
                let shows = |it: &u32| self.holds(*it) == Some(value);
                let some: Vec<u32> = all.into_iter().filter(shows).collect();
                // A part that one marking shows is preferred to one that needs a run.
                if some.iter().any(|it| self.is_state(*it)) {
                    return true;
                }
                let run = some.iter().copied().find(|it| self.is_run(*it, value));
                run.or_else(|| some.first().copied()).is_some_and(|it| self.show(it, value))
            }
            (CtlNode::Next(a), true) => {
                let Some(arc) =
                    graph.successors(self.state).iter().position(|it| self.is_goal(a, *it))
                else {
                    return false;
                };
                self.step(arc);
                self.show(a, true)
            }
            (CtlNode::Next(_), false) => graph.successors(self.state).is_empty(),
            (CtlNode::Until(a, b), true) => {
                let Some(ranks) = &self.labelling.ranks[node as usize] else { return false };
                self.has_run = true;
                while ranks[self.state as usize] != 0 {
                    let rank = ranks[self.state as usize];
                    let closer = |it: &u32| ranks[*it as usize] < rank;
                    let Some(arc) = graph.successors(self.state).iter().position(closer) else {
                        return false;
                    };
                    self.step(arc);
                }
                let is_shown = self.show(b, true);
                is_shown && self.is_state(a)
            }
            (CtlNode::Until(a, b), false) => {
                let neither = self.holds(a) == Some(false) && self.holds(b) == Some(false);
                neither && self.is_state(a) && self.is_state(b)
            }
            (CtlNode::Globally(a), true) => {
                let Some(region) = &self.labelling.labels[node as usize] else { return false };
                self.go_on(region);
                self.is_state(a)
            }
            (CtlNode::Globally(a), false) => self.is_state(a) && self.holds(a) == Some(false),
        }
    }

    /// Whether a run begins to show this.
    fn is_run(&self, node: u32, value: bool) -> bool {
        match self.node(node) {
            CtlNode::State(_) => false,
            CtlNode::Not(a) => self.is_run(*a, !value),
            CtlNode::And(all) | CtlNode::Or(all) => all.iter().any(|it| self.is_run(*it, value)),
            _ => value,
        }
    }

    fn is_goal(&self, node: u32, state: u32) -> bool {
        let holds = |label: &Option<BitSet>| label.as_ref().is_some_and(|it| it.has(state));
        let is_fair = self.labelling.sets.fair_states.as_ref().is_none_or(|it| it.has(state));
        is_fair && holds(&self.labelling.labels[node as usize])
    }

    fn step(&mut self, arc: usize) {
        debug_assert!(self.rest == Rest::Any, "a run that goes round takes no further step");
        self.has_run = true;
        self.fired.push(self.labelling.sets.graph.transitions(self.state)[arc]);
        self.state = self.labelling.sets.graph.successors(self.state)[arc];
    }

    /// A fair run through a region from here for ever.
    fn go_on(&mut self, region: &BitSet) {
        debug_assert!(region.has(self.state), "the run is in the region");
        self.has_run = true;
        let sets = self.labelling.sets.fair_sets(region);
        let (stem, rest) = self.labelling.sets.fair.run(self.state, region, &sets);
        self.fired.extend(stem);
        self.rest = rest;
    }
}
