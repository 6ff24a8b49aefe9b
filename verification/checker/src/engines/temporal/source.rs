//! The sources of the product's states: markings that are met one by one, or a graph that is there
//! already.

use super::stop::{NONE, Stop};
use super::successors::Successors;
use crate::explicit::{BitSet, Goal, Limit, Limits, Markings, Memory};
use crate::stubborn::{Closure, visible};
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;
use cotama_property::{Condition, Ltl, LtlNode};
use std::time::Instant;

/// States, with numbers in the order in which they are met; the first one has number 0.
pub(super) trait Source {
    fn memory(&mut self) -> &mut Memory;

    /// How many states were met.
    fn len(&self) -> usize;

    /// # Errors
    /// [`Limit::Time`] when time is up.
    fn check_time(&self) -> Result<(), Limit>;

    /// For each part of the formula that is about one state whether it holds, a bit each.
    fn valuation(&mut self, state: u32) -> Vec<u64>;

    /// Whether a step leads anywhere: what fires in a state; [`NONE`] alone in a deadlock.
    fn transitions(&mut self, state: u32) -> Vec<u32>;

    /// Transitions that suffice, unless they close a cycle; none of them is seen. `None` when all
    /// are to be fired.
    fn few(&mut self, state: u32) -> Option<Vec<u32>>;

    /// The state after a transition.
    fn fire(&mut self, state: u32, transition: u32) -> Result<u32, Limit>;

    /// The state after a transition, if it was met before.
    fn known(&mut self, state: u32, transition: u32) -> Option<u32>;

    /// Whether no transition leads to one state from two.
    fn is_injective(&self) -> bool;
}

/// Markings that are met one by one.
pub(super) struct Met<'a> {
    markings: Markings<'a>,
    conditions: Vec<Condition<'a>>,
    /// Closure for stubborn sets, and the transitions that the formula sees; `None` when nothing
    /// may be left out.
    reduction: Option<(Closure<'a>, Vec<bool>)>,
    is_injective: bool,
}

impl<'a> Met<'a> {
    pub(super) fn new(pt: &'a Pt, formula: &'a Ltl, limits: &Limits) -> Result<Self, Stop> {
        let (mut conditions, mut seen) = (Vec::new(), vec![false; pt.transitions.len()]);
        let mut steps = false;
        for node in formula.nodes() {
            match node {
                LtlNode::State(state) => {
                    // The parts of a formula of LTL that are called states speak of one marking.
                    conditions.push(Condition::new(state, pt).ok_or(Stop::TooLarge)?);
                    seen.iter_mut().zip(visible(pt, state)).for_each(|(seen, it)| *seen |= it);
                }
                LtlNode::Next(_) | LtlNode::Fires(_) => steps = true,
                _ => {}
            }
        }
        let may_leave_out = pt.is_plain() && !steps && seen.iter().any(|it| !it);
        let reduction = may_leave_out.then(|| (Closure::new(pt), seen));
        let (markings, is_injective) = (Markings::new(pt, limits)?, !pt.has_resets());
        Ok(Self { markings, conditions, reduction, is_injective })
    }
}

impl Source for Met<'_> {
    fn memory(&mut self) -> &mut Memory {
        &mut self.markings.memory
    }

    fn len(&self) -> usize {
        self.markings.len()
    }

    fn check_time(&self) -> Result<(), Limit> {
        self.markings.check_time()
    }

    fn valuation(&mut self, state: u32) -> Vec<u64> {
        let look = self.markings.look(state);
        let mut holds = vec![0; self.conditions.len().div_ceil(64)];
        for (at, condition) in self.conditions.iter().enumerate() {
            holds[at / 64] |= u64::from(condition.holds(&look)) << (at % 64);
        }
        holds
    }

    fn transitions(&mut self, state: u32) -> Vec<u32> {
        let all: Vec<u32> = self.markings.look(state).transitions().collect();
        if all.is_empty() { vec![NONE] } else { all }
    }

    fn few(&mut self, state: u32) -> Option<Vec<u32>> {
        let (closure, seen) = self.reduction.as_mut()?;
        let look = self.markings.look(state);
        let few = closure.persistent(look, |it| !seen[it as usize])?;
        (few.len() < look.transitions().count()).then_some(few)
    }

    fn fire(&mut self, state: u32, transition: u32) -> Result<u32, Limit> {
        if transition == NONE { Ok(state) } else { self.markings.fire(state, transition) }
    }

    fn known(&mut self, state: u32, transition: u32) -> Option<u32> {
        if transition == NONE { Some(state) } else { self.markings.known(state, transition) }
    }

    fn is_injective(&self) -> bool {
        self.is_injective
    }
}

/// States of a graph, in which a transition leads to one state at most.
pub(super) struct Stored<'g, S> {
    graph: &'g S,
    labels: Vec<BitSet>,
    memory: Memory,
    deadline: Option<Instant>,
}

impl<'g, S: Successors> Stored<'g, S> {
    pub(super) fn new(
        graph: &'g S,
        formula: &Ltl,
        limits: &Limits,
        jobs: usize,
    ) -> Result<Self, Stop> {
        let (mut labels, mut memory) = (Vec::new(), Memory::new(limits.bytes));
        for node in formula.nodes() {
            if let LtlNode::State(state) = node {
                memory.take(BitSet::bytes(graph.states()))?;
                let goal = Goal::new(state).ok_or(Stop::TooLarge)?;
                labels.push(graph.satisfying(goal, jobs));
            }
        }
        Ok(Self { graph, labels, memory, deadline: limits.deadline })
    }
}

impl<S: Successors> Source for Stored<'_, S> {
    fn memory(&mut self) -> &mut Memory {
        &mut self.memory
    }

    fn len(&self) -> usize {
        self.graph.states()
    }

    fn check_time(&self) -> Result<(), Limit> {
        let is_over = self.deadline.is_some_and(|it| Instant::now() >= it);
        if is_over { Err(Limit::Time) } else { Ok(()) }
    }

    fn valuation(&mut self, state: u32) -> Vec<u64> {
        let mut holds = vec![0; self.labels.len().div_ceil(64)];
        for (at, label) in self.labels.iter().enumerate() {
            holds[at / 64] |= u64::from(label.has(state)) << (at % 64);
        }
        holds
    }

    fn transitions(&mut self, state: u32) -> Vec<u32> {
        let all: Vec<u32> = self.graph.transitions(state).into_iter().map(|it| it.0).collect();
        if all.is_empty() { vec![NONE] } else { all }
    }

    fn few(&mut self, _: u32) -> Option<Vec<u32>> {
        None
    }

    fn fire(&mut self, state: u32, transition: u32) -> Result<u32, Limit> {
        Ok(self.known(state, transition).unwrap_or(state))
    }

    fn known(&mut self, state: u32, transition: u32) -> Option<u32> {
        if transition == NONE {
            return Some(state);
        }
        let fired = self.graph.transitions(state);
        let at = fired.binary_search(&TransitionId(transition)).ok()?;
        self.graph.successors(state).get(at).copied()
    }

    fn is_injective(&self) -> bool {
        self.graph.is_injective()
    }
}
