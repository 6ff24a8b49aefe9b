//! The net and an automaton side by side, as far as they are followed.

use super::automaton::{Automaton, Move, TooLarge};
use crate::explicit::{Index, Limit, Limits, Markings, hash};
use crate::property::{Condition, Ltl, LtlNode};
use crate::pt::Pt;
use crate::stubborn::{Closure, visible};
use std::collections::HashMap;

/// No transition: after a deadlock the marking lasts.
pub(super) const NONE: u32 = u32::MAX;

/// Why something is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    Limit(Limit),
    TooLarge,
}

impl From<Limit> for Stop {
    fn from(limit: Limit) -> Self {
        Self::Limit(limit)
    }
}

impl From<TooLarge> for Stop {
    fn from(_: TooLarge) -> Self {
        Self::TooLarge
    }
}

/// Pairs of a marking and a state of the automaton, with numbers in the order in which they are
/// met.
pub(super) struct Product<'a> {
    pub(super) markings: Markings<'a>,
    pub(super) automaton: Automaton<'a>,
    conditions: Vec<Condition<'a>>,
    /// For each marking the number of its valuation; [`NONE`] when it was not looked at.
    valuation_of: Vec<u32>,
    valuations: Vec<Vec<u64>>,
    numbers: HashMap<Vec<u64>, u32>,
    pairs: Vec<(u32, u32)>,
    index: Index,
    /// What may be left out, and the transitions that the formula sees; `None` when nothing may.
    reduction: Option<(Closure<'a>, Vec<bool>)>,
}

impl<'a> Product<'a> {
    pub(super) fn new(pt: &'a Pt, formula: &'a Ltl, limits: &Limits) -> Result<Self, Stop> {
        let (mut conditions, mut seen) = (Vec::new(), vec![false; pt.transitions.len()]);
        let mut next = false;
        for node in formula.nodes() {
            match node {
                LtlNode::State(state) => {
                    // The parts of a formula of LTL that are called states speak of one marking.
                    conditions.push(Condition::new(state, pt).ok_or(Stop::TooLarge)?);
                    seen.iter_mut().zip(visible(pt, state)).for_each(|(seen, it)| *seen |= it);
                }
                LtlNode::Next(_) => next = true,
                _ => {}
            }
        }
        let reduction = (!next && seen.iter().any(|it| !it)).then(|| (Closure::new(pt), seen));
        let mut product = Self {
            markings: Markings::new(pt, limits)?,
            automaton: Automaton::new(formula)?,
            conditions,
            valuation_of: Vec::new(),
            valuations: Vec::new(),
            numbers: HashMap::new(),
            pairs: Vec::new(),
            index: Index::default(),
            reduction,
        };
        product.pair(0, 0)?;
        Ok(product)
    }

    /// How many pairs were met.
    pub(super) fn len(&self) -> usize {
        self.pairs.len()
    }

    /// The marking and the state of a pair.
    pub(super) fn of(&self, pair: u32) -> (u32, u32) {
        self.pairs[pair as usize]
    }

    /// The number of a pair; a new one gets the next number.
    pub(super) fn pair(&mut self, marking: u32, state: u32) -> Result<u32, Limit> {
        match self.found(marking, state) {
            Ok(pair) => Ok(pair),
            Err(slot) => {
                let pair = self.pairs.len() as u32;
                if pair == NONE {
                    return Err(Limit::States);
                }
                self.markings.memory.room(&mut self.pairs, 1)?;
                self.pairs.push((marking, state));
                let pairs = &self.pairs;
                let hash_of = |it: u32| mixed(pairs[it as usize]);
                self.index.insert(slot, pair, &mut self.markings.memory, hash_of)?;
                Ok(pair)
            }
        }
    }

    /// The number of a pair if it was met.
    pub(super) fn known(&self, marking: u32, state: u32) -> Option<u32> {
        self.found(marking, state).ok()
    }

    fn found(&self, marking: u32, state: u32) -> Result<u32, usize> {
        self.index.find(mixed((marking, state)), |it| self.pairs[it as usize] == (marking, state))
    }

    /// The moves of the automaton from a pair.
    pub(super) fn moves(&mut self, pair: u32) -> Result<Vec<Move>, Stop> {
        let (marking, state) = self.of(pair);
        let valuation = self.valuation(marking)?;
        Ok(self.automaton.moves(state, valuation, &self.valuations[valuation as usize])?.to_vec())
    }

    fn valuation(&mut self, marking: u32) -> Result<u32, Limit> {
        let met = self.markings.len();
        self.markings.memory.extend(&mut self.valuation_of, met, NONE)?;
        if self.valuation_of[marking as usize] == NONE {
            let look = self.markings.look(marking);
            let mut holds = vec![0; self.conditions.len().div_ceil(64)];
            for (at, condition) in self.conditions.iter().enumerate() {
                holds[at / 64] |= u64::from(condition.holds(&look)) << (at % 64);
            }
            let number = *self.numbers.entry(holds).or_insert_with_key(|holds| {
                self.valuations.push(holds.clone());
                self.valuations.len() as u32 - 1
            });
            self.valuation_of[marking as usize] = number;
        }
        Ok(self.valuation_of[marking as usize])
    }

    /// The transitions that are enabled in a marking; [`NONE`] alone in a deadlock.
    pub(super) fn transitions(&mut self, marking: u32) -> Vec<u32> {
        let all: Vec<u32> = self.markings.look(marking).transitions().collect();
        if all.is_empty() { vec![NONE] } else { all }
    }

    /// Transitions that suffice, unless they close a cycle; none of them is seen. `None` when all
    /// are to be fired.
    pub(super) fn few(&mut self, marking: u32) -> Option<Vec<u32>> {
        let (closure, seen) = self.reduction.as_mut()?;
        let look = self.markings.look(marking);
        let few = closure.persistent(look, |it| !seen[it as usize])?;
        (few.len() < look.transitions().count()).then_some(few)
    }

    /// The marking after a transition.
    pub(super) fn fire(&mut self, marking: u32, transition: u32) -> Result<u32, Limit> {
        if transition == NONE { Ok(marking) } else { self.markings.fire(marking, transition) }
    }

    /// The steps from a pair to pairs that were met: transition, pair, promises.
    pub(super) fn steps(&mut self, pair: u32) -> Vec<(u32, u32, u128)> {
        // The moves of a pair that was left were worked out then.
        let Ok(moves) = self.moves(pair) else { return Vec::new() };
        let marking = self.of(pair).0;
        let mut steps = Vec::new();
        for transition in self.transitions(marking) {
            let after = if transition == NONE {
                Some(marking)
            } else {
                self.markings.known(marking, transition)
            };
            let Some(after) = after else { continue };
            for step in &moves {
                steps.extend(self.known(after, step.to).map(|to| (transition, to, step.promises)));
            }
        }
        steps
    }
}

fn mixed((marking, state): (u32, u32)) -> u64 {
    hash(&[u64::from(marking) << 32 | u64::from(state)])
}
