//! A net and an automaton side by side, as far as they are followed.

use super::automaton::{Automaton, Move};
use super::source::Source;
use super::stop::{NONE, Stop};
use crate::explicit::{Index, Limit, hash};
use cotama_property::{Ltl, LtlNode};
use std::collections::HashMap;

/// Pairs of a state and a state of the automaton, with numbers in the order in which they are met.
pub(super) struct Product<'a, S> {
    pub(super) source: S,
    pub(super) automaton: Automaton<'a>,
    /// For each state the number of its valuation; [`NONE`] when it was not looked at.
    valuation_of: Vec<u32>,
    valuations: Vec<Vec<u64>>,
    numbers: HashMap<Vec<u64>, u32>,
    /// The transitions whose firings the formula sees, with their bits behind those of the
    /// valuation of a state; and how many words all bits take.
    fires: Vec<(u32, usize)>,
    words: usize,
    pairs: Vec<(u32, u32)>,
    index: Index,
}

impl<'a, S: Source> Product<'a, S> {
    pub(super) fn new(source: S, formula: &'a Ltl) -> Result<Self, Stop> {
        let is_state = |it: &&LtlNode| matches!(it, LtlNode::State(_));
        let first = formula.nodes().iter().filter(is_state).count();
        let seen = formula.nodes().iter().filter_map(|it| match it {
            LtlNode::Fires(transition) => Some(transition.0),
            _ => None,
        });
        let fires: Vec<(u32, usize)> = seen.zip(first..).collect();
        let mut product = Self {
            source,
            automaton: Automaton::new(formula)?,
            valuation_of: Vec::new(),
            valuations: Vec::new(),
            numbers: HashMap::new(),
            words: (first + fires.len()).div_ceil(64),
            fires,
            pairs: Vec::new(),
            index: Index::default(),
        };
        product.pair(0, 0)?;
        Ok(product)
    }

    /// How many pairs were met.
    pub(super) fn len(&self) -> usize {
        self.pairs.len()
    }

    /// The two states of a pair.
    pub(super) fn of(&self, pair: u32) -> (u32, u32) {
        self.pairs[pair as usize]
    }

    /// The number of a pair; a new one gets the next number.
    pub(super) fn pair(&mut self, state: u32, automaton: u32) -> Result<u32, Limit> {
        match self.found(state, automaton) {
            Ok(pair) => Ok(pair),
            Err(slot) => {
                let pair = self.pairs.len() as u32;
                if pair == NONE {
                    return Err(Limit::States);
                }
                self.source.memory().room(&mut self.pairs, 1)?;
                self.pairs.push((state, automaton));
                let pairs = &self.pairs;
                let hash_of = |it: u32| mixed(pairs[it as usize]);
                self.index.insert(slot, pair, self.source.memory(), hash_of)?;
                Ok(pair)
            }
        }
    }

    /// The number of a pair if it was met.
    pub(super) fn known(&self, state: u32, automaton: u32) -> Option<u32> {
        self.found(state, automaton).ok()
    }

    fn found(&self, state: u32, automaton: u32) -> Result<u32, usize> {
        let pair = (state, automaton);
        self.index.find(mixed(pair), |it| self.pairs[it as usize] == pair)
    }

    /// Whether the moves of the automaton depend on what fires.
    pub(super) fn sees_firings(&self) -> bool {
        !self.fires.is_empty()
    }

    /// The moves of the automaton from a pair, when this fires.
    pub(super) fn moves(&mut self, pair: u32, fired: u32) -> Result<Vec<Move>, Stop> {
        let (state, automaton) = self.of(pair);
        let mut valuation = self.valuation(state)?;
        if let Some(&(_, bit)) = self.fires.iter().find(|it| it.0 == fired) {
            let mut holds = self.valuations[valuation as usize].clone();
            holds[bit / 64] |= 1 << (bit % 64);
            valuation = self.number(holds);
        }
        let holds = &self.valuations[valuation as usize];
        Ok(self.automaton.moves(automaton, valuation, holds)?.to_vec())
    }

    fn valuation(&mut self, state: u32) -> Result<u32, Limit> {
        let met = self.source.len();
        self.source.memory().extend(&mut self.valuation_of, met, NONE)?;
        if self.valuation_of[state as usize] == NONE {
            let mut holds = self.source.valuation(state);
            holds.resize(self.words, 0);
            self.valuation_of[state as usize] = self.number(holds);
        }
        Ok(self.valuation_of[state as usize])
    }

    fn number(&mut self, holds: Vec<u64>) -> u32 {
        *self.numbers.entry(holds).or_insert_with_key(|holds| {
            self.valuations.push(holds.clone());
            self.valuations.len() as u32 - 1
        })
    }

    /// The steps from a pair to pairs that were met: transition, pair, promises.
    pub(super) fn steps(&mut self, pair: u32) -> Vec<(u32, u32, u128)> {
        let state = self.of(pair).0;
        let mut steps = Vec::new();
        for transition in self.source.transitions(state) {
            // The moves of a pair that was left were worked out then.
            let Ok(moves) = self.moves(pair, transition) else { return Vec::new() };
            let Some(after) = self.source.known(state, transition) else { continue };
            for step in &moves {
                steps.extend(self.known(after, step.to).map(|to| (transition, to, step.promises)));
            }
        }
        steps
    }
}

fn mixed((state, automaton): (u32, u32)) -> u64 {
    hash(&[u64::from(state) << 32 | u64::from(automaton)])
}
