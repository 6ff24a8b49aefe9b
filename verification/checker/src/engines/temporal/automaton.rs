//! A formula of LTL as a generalised Büchi automaton, made as far as it is used.
//!
//! A state is a set of parts of the formula that the rest of the run has to meet (J.-M. Couvreur,
//! *On-the-fly verification of linear temporal logic*, 1999). What a marking says is put in at
//! once, so that a move is made of a state and of a valuation: which of the parts about one marking
//! hold. A move that puts off an `Until` makes a promise; a run is accepted when it makes none of
//! them for ever.

use cotama_property::{Ltl, LtlNode};
use std::collections::{BTreeSet, HashMap};

/// A step of the automaton.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Move {
    /// The state it leads to.
    pub(super) to: u32,
    /// A bit for each `Until` that is put off.
    pub(super) promises: u128,
}

/// The automaton has more than 128 promises, or a state more moves than are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TooLarge;

/// Moves of one state on one valuation that are looked at.
const BRANCHES: usize = 1 << 14;

#[derive(Debug)]
pub(super) struct Automaton<'f> {
    formula: &'f Ltl,
    /// Sets of parts, sorted; they are the states.
    states: Vec<Vec<u32>>,
    numbers: HashMap<Vec<u32>, u32>,
    /// For each part its bit among the promises.
    bits: HashMap<u32, u32>,
    /// For each part about one marking its position in valuations, and behind them for each part
    /// about a firing.
    atoms: HashMap<u32, usize>,
    moves: HashMap<(u32, u32), Vec<Move>>,
}

/// One way to meet what a state asks for, as it is worked out.
#[derive(Clone, Debug, Default)]
struct Branch {
    now: Vec<u32>,
    done: BTreeSet<u32>,
    next: Vec<u32>,
    promises: u128,
}

impl<'f> Automaton<'f> {
    pub(super) fn new(formula: &'f Ltl) -> Result<Self, TooLarge> {
        let (mut bits, mut atoms) = (HashMap::new(), HashMap::new());
        for (at, node) in formula.nodes().iter().enumerate() {
            match node {
                LtlNode::Until(..) => {
                    let bit = bits.len() as u32;
                    bits.insert(at as u32, bit);
                }
                LtlNode::State(_) => {
                    let position = atoms.len();
                    atoms.insert(at as u32, position);
                }
                _ => {}
            }
        }
        for (at, node) in formula.nodes().iter().enumerate() {
            if let LtlNode::Fires(_) = node {
                let position = atoms.len();
                atoms.insert(at as u32, position);
            }
        }
        if bits.len() > 128 {
            return Err(TooLarge);
        }
        let (states, numbers, moves) = (Vec::new(), HashMap::new(), HashMap::new());
        let mut automaton = Self { formula, states, numbers, bits, atoms, moves };
        let first = automaton.simplified(vec![formula.root()]);
        automaton.state(first);
        Ok(automaton)
    }

    /// All promises: a run is accepted when for each of them it has moves without it again and
    /// again.
    pub(super) fn promises(&self) -> u128 {
        if self.bits.len() == 128 { u128::MAX } else { (1 << self.bits.len()) - 1 }
    }

    /// Whether every run from this state is accepted.
    pub(super) fn accepts_all(&self, state: u32) -> bool {
        self.states[state as usize].is_empty()
    }

    /// The moves of a state on a valuation: a bit for each part about one marking, in their order,
    /// and then one for each part about a firing. `valuation` is its number.
    pub(super) fn moves(
        &mut self,
        state: u32,
        valuation: u32,
        holds: &[u64],
    ) -> Result<&[Move], TooLarge> {
        debug_assert!(self.atoms.len() <= 64 * holds.len(), "a bit for each part");
        if !self.moves.contains_key(&(state, valuation)) {
            let moves = self.worked_out(state, holds)?;
            self.moves.insert((state, valuation), moves);
        }
        Ok(&self.moves[&(state, valuation)])
    }

    fn state(&mut self, set: Vec<u32>) -> u32 {
        if let Some(&state) = self.numbers.get(&set) {
            return state;
        }
        let state = self.states.len() as u32;
        debug_assert!(set.is_sorted(), "a set is written in one way");
        self.states.push(set.clone());
        self.numbers.insert(set, state);
        state
    }

    fn node(&self, at: u32) -> &'f LtlNode {
        &self.formula.nodes()[at as usize]
    }

    /// For each part whether a marking decides it.
    fn known(&self, holds: &[u64]) -> Vec<Option<bool>> {
        let mut known: Vec<Option<bool>> = Vec::with_capacity(self.formula.nodes().len());
        for (at, node) in self.formula.nodes().iter().enumerate() {
            let of = |it: &u32| known[*it as usize];
            let is = |it: &u32, value| of(it) == Some(value);
            known.push(match node {
                LtlNode::State(_) | LtlNode::Fires(_) => {
                    self.atoms.get(&(at as u32)).map(|it| holds[it / 64] >> (it % 64) & 1 == 1)
                }
                LtlNode::And(all) if all.iter().any(|it| is(it, false)) => Some(false),
                LtlNode::And(all) if all.iter().all(|it| is(it, true)) => Some(true),
                LtlNode::Or(all) if all.iter().any(|it| is(it, true)) => Some(true),
                LtlNode::Or(all) if all.iter().all(|it| is(it, false)) => Some(false),
                LtlNode::Until(_, b) if is(b, true) => Some(true),
                LtlNode::Until(a, b) if is(a, false) && is(b, false) => Some(false),
                LtlNode::Release(_, b) if is(b, false) => Some(false),
                LtlNode::Release(a, b) if is(a, true) && is(b, true) => Some(true),
                _ => None,
            });
        }
        known
    }

    fn worked_out(&mut self, state: u32, holds: &[u64]) -> Result<Vec<Move>, TooLarge> {
        let known = self.known(holds);
        let mut found: Vec<(Vec<u32>, u128)> = Vec::new();
        let mut branches =
            vec![Branch { now: self.states[state as usize].clone(), ..Branch::default() }];
        let mut count = 0;
        while let Some(mut branch) = branches.pop() {
            count += 1;
            if count > BRANCHES {
                return Err(TooLarge);
            }
            if !self.grow(&mut branch, &known, &mut branches) {
                continue;
            }
            let (next, promises) = (self.simplified(branch.next), branch.promises);
            // A move that asks for more and promises more than another one adds nothing.
            let is_less = |a: &(Vec<u32>, u128), b: &(Vec<u32>, u128)| {
                a.1 & !b.1 == 0 && a.0.iter().all(|it| b.0.binary_search(it).is_ok())
            };
            let new = (next, promises);
            if !found.iter().any(|it| is_less(it, &new)) {
                found.retain(|it| !is_less(&new, it));
                found.push(new);
            }
        }
        found.sort_by(|a, b| (a.0.len(), a.1, &a.0).cmp(&(b.0.len(), b.1, &b.0)));
        Ok(found
            .into_iter()
            .map(|(next, promises)| Move { to: self.state(next), promises })
            .collect())
    }

    /// Works out all that is asked for now; `false` when it cannot be met.
    fn grow(&self, branch: &mut Branch, known: &[Option<bool>], others: &mut Vec<Branch>) -> bool {
        while let Some(part) = branch.now.pop() {
            match known[part as usize] {
                Some(true) => continue,
                Some(false) => return false,
                None if !branch.done.insert(part) => continue,
                None => {}
            }
            let is = |it: u32, value| known[it as usize] == Some(value);
            match self.node(part) {
                // Every marking, and every firing, decides it.
                LtlNode::State(_) | LtlNode::Fires(_) => {}
                LtlNode::And(all) => branch.now.extend(all),
                LtlNode::Or(all) => {
                    let mut open = all.iter().filter(|it| !is(**it, false));
                    let first = open.next();
                    for other in open {
                        let mut with = branch.clone();
                        with.now.push(*other);
                        others.push(with);
                    }
                    branch.now.extend(first);
                }
                LtlNode::Next(a) => branch.next.push(*a),
                LtlNode::Until(a, b) => {
                    if !is(*b, false) {
                        let mut with = branch.clone();
                        with.now.push(*b);
                        others.push(with);
                    }
                    branch.now.push(*a);
                    branch.next.push(part);
                    branch.promises |= 1 << self.bits[&part];
                }
                LtlNode::Release(a, b) => {
                    if !is(*a, false) {
                        let mut with = branch.clone();
                        with.now.extend([*a, *b]);
                        others.push(with);
                    }
                    branch.now.push(*b);
                    branch.next.push(part);
                }
            }
        }
        true
    }

    /// A set that asks for the same, without what others in it imply.
    fn simplified(&self, parts: Vec<u32>) -> Vec<u32> {
        let (mut set, mut open) = (BTreeSet::new(), parts);
        while let Some(part) = open.pop() {
            match self.node(part) {
                LtlNode::And(all) => open.extend(all),
                _ => {
                    set.insert(part);
                }
            }
        }
        let has = |it: &u32| set.contains(it);
        let implied = |part: &u32| match self.node(*part) {
            LtlNode::Or(all) => all.iter().any(has),
            LtlNode::Until(_, b) => has(b),
            LtlNode::Release(a, b) => has(a) && has(b),
            _ => false,
        };
        set.iter().copied().filter(|it| !implied(it)).collect()
    }
}
