//! The tree of ω-markings.

use super::antichain::Antichain;
use super::tokens::{Tokens, at_most, support};
use super::word::{Part, Pumps, Sequence, Word};
use super::{Growth, Limit, Limits, Unfinished};
use cotama_core::net::PlaceId;
use cotama_property::pt::Pt;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

/// Which marking is worked on next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// The one that was met first: sequences are short.
    First,
    /// The one with the most ω, then the most tokens: it covers many others.
    Greatest,
}

#[derive(Debug)]
struct Node {
    /// Parent node and transition; `None` for the initial marking.
    parent: Option<(u32, u32)>,
    /// Pumps after the transition, in `Search::raised`.
    raised: Range<u32>,
    support: u64,
    /// Whether a greater marking is known: then what follows from this one is covered without it.
    is_covered: bool,
}

/// A marking that is not a node yet.
struct Candidate {
    marking: Vec<Tokens>,
    parent: Option<(u32, u32)>,
    raised: Vec<u32>,
}

/// The search for the maximal markings.
#[derive(Debug)]
pub(super) struct Search<'n> {
    pub(super) pt: &'n Pt,
    /// Node by node.
    markings: Vec<Tokens>,
    nodes: Vec<Node>,
    raised: Vec<u32>,
    pumps: Pumps,
    maximal: Antichain,
    waiting: BinaryHeap<(u64, u128, Reverse<u32>)>,
    order: Order,
}

impl<'n> Search<'n> {
    pub(super) fn new(pt: &'n Pt, order: Order) -> Self {
        Self {
            pt,
            markings: Vec::new(),
            nodes: Vec::new(),
            raised: Vec::new(),
            pumps: Pumps::of(pt),
            maximal: Antichain::new(pt.places.len()),
            waiting: BinaryHeap::new(),
            order,
        }
    }

    /// Goes on until all markings are covered, or until one is `found`: its number.
    pub(super) fn run(
        &mut self,
        limits: &Limits,
        found: &mut dyn FnMut(&[Tokens]) -> bool,
    ) -> Result<Option<u32>, Unfinished> {
        self.grow(limits, found).map_err(|limit| Unfinished { limit, nodes: self.nodes() })
    }

    fn grow(
        &mut self,
        limits: &Limits,
        found: &mut dyn FnMut(&[Tokens]) -> bool,
    ) -> Result<Option<u32>, Limit> {
        let marking = self.pt.initial.iter().map(|&it| Tokens::from(it)).collect();
        let mut met = self.add(Candidate { marking, parent: None, raised: Vec::new() }, limits)?;
        loop {
            if let Some(id) = met.filter(|&it| found(self.marking(it))) {
                return Ok(Some(id));
            }
            let Some((_, _, Reverse(id))) = self.waiting.pop() else { return Ok(None) };
            met = None;
            for transition in 0..self.pt.transitions.len() as u32 {
                if self.nodes[id as usize].is_covered {
                    break;
                }
                let Some(marking) = self.fired(id, transition)? else { continue };
                if limits.is_over() {
                    return Err(Limit::Time);
                }
                if self.maximal.covers(&marking, &self.markings) {
                    continue;
                }
                let candidate =
                    Candidate { marking, parent: Some((id, transition)), raised: Vec::new() };
                if let Some(id) = self.add(candidate, limits)?.filter(|&it| found(self.marking(it)))
                {
                    return Ok(Some(id));
                }
            }
        }
    }

    /// The marking after a transition, if it is enabled.
    fn fired(&self, id: u32, transition: u32) -> Result<Option<Vec<Tokens>>, Limit> {
        let marking = self.marking(id);
        let needs = self.pt.needs.of(transition);
        if !needs.iter().all(|&(place, tokens)| marking[place as usize] >= Tokens::from(tokens)) {
            return Ok(None);
        }
        let mut after = marking.to_vec();
        for &(place, change) in self.pt.effects.of(transition) {
            let tokens = &mut after[place as usize];
            *tokens = tokens.changed(change).ok_or(Limit::Tokens)?;
        }
        Ok(Some(after))
    }

    /// Makes a node of the limit of a candidate that is not covered.
    fn add(&mut self, mut candidate: Candidate, limits: &Limits) -> Result<Option<u32>, Limit> {
        self.raise(&mut candidate)?;
        if !candidate.raised.is_empty() && self.maximal.covers(&candidate.marking, &self.markings) {
            return Ok(None);
        }
        // A node, its place in the heap, the antichain and the table of hashes.
        let bytes = self.bytes() + self.pt.places.len() as u64 * 8 + 160;
        if self.nodes() >= limits.states.min(u64::from(u32::MAX) - 1) {
            return Err(Limit::States);
        }
        if bytes > limits.bytes {
            return Err(Limit::Bytes);
        }
        let id = self.nodes.len() as u32;
        let start = self.raised.len() as u32;
        self.raised.extend(candidate.raised);
        self.markings.extend_from_slice(&candidate.marking);
        self.nodes.push(Node {
            parent: candidate.parent,
            raised: start..self.raised.len() as u32,
            support: support(&candidate.marking),
            is_covered: false,
        });
        let nodes = &mut self.nodes;
        self.maximal.add(id, &self.markings, |it| nodes[it as usize].is_covered = true);
        let (omegas, sum) = match self.order {
            Order::First => (0, 0),
            Order::Greatest => {
                let finite = candidate.marking.iter().filter_map(|it| it.finite());
                let omegas = candidate.marking.iter().filter(|it| it.is_omega()).count() as u64;
                (omegas, finite.map(u128::from).sum())
            }
        };
        self.waiting.push((omegas, sum, Reverse(id)));
        Ok(Some(id))
    }

    /// Repeats all pumps for ever that a marking allows: known ones, and those that lead to it from
    /// a smaller marking.
    fn raise(&mut self, candidate: &mut Candidate) -> Result<(), Limit> {
        loop {
            let known =
                (0..self.pumps.all.len()).find(|&it| self.pumps.all[it].raises(&candidate.marking));
            let pump = match known {
                Some(known) => known,
                None => match self.smaller(candidate) {
                    Some(ancestor) => {
                        let word = self.path(ancestor, candidate).ok_or(Limit::Tokens)?;
                        let pump = self.pumps.add(self.pt, word).ok_or(Limit::Tokens)?;
                        debug_assert!(pump.raises(&candidate.marking));
                        if !pump.raises(&candidate.marking) {
                            return Err(Limit::Tokens);
                        }
                        self.pumps.all.len() - 1
                    }
                    None => return Ok(()),
                },
            };
            self.pumps.all[pump].raise(&mut candidate.marking);
            candidate.raised.push(pump as u32);
        }
    }

    /// The next ancestor that is smaller, and not only where the candidate has ω.
    fn smaller(&self, candidate: &Candidate) -> Option<u32> {
        let support = support(&candidate.marking);
        let mut at = candidate.parent;
        while let Some((id, _)) = at {
            let node = &self.nodes[id as usize];
            let marking = self.marking(id);
            if node.support & !support == 0
                && at_most(marking, &candidate.marking)
                && marking
                    .iter()
                    .zip(&candidate.marking)
                    .any(|(it, other)| it < other && !other.is_omega())
            {
                return Some(id);
            }
            at = node.parent;
        }
        None
    }

    /// A sequence that leads from an ancestor to a candidate, to as many tokens as both have
    /// numbers of, and to more than before where only the candidate has ω.
    fn path(&self, ancestor: u32, candidate: &Candidate) -> Option<Word> {
        let ends = self.marking(ancestor).iter().zip(&candidate.marking);
        let mut demand = ends
            .map(|(start, end)| match start.finite() {
                Some(tokens) if end.is_omega() => tokens.checked_add(1),
                _ => Some(0),
            })
            .collect::<Option<Vec<u64>>>()?;
        let mut word = Word::new();
        self.back(candidate.parent, &candidate.raised, &mut demand, &mut word)?;
        let mut at = candidate.parent?.0;
        while at != ancestor {
            let node = &self.nodes[at as usize];
            self.back(node.parent, self.raised_of(node), &mut demand, &mut word)?;
            at = node.parent?.0;
        }
        word.reverse();
        Some(word)
    }

    /// Goes back over one edge of the tree: what is needed before so that `demand` is there after.
    /// Adds to the word from its end.
    fn back(
        &self,
        parent: Option<(u32, u32)>,
        raised: &[u32],
        demand: &mut [u64],
        word: &mut Word,
    ) -> Option<()> {
        let mut marking = match parent {
            Some((id, transition)) => self.fired(id, transition).ok()??,
            None => self.pt.initial.iter().map(|&it| Tokens::from(it)).collect(),
        };
        // The marking before each of the pumps.
        let mut before = Vec::new();
        for &pump in raised {
            before.push((pump, marking.clone()));
            self.pumps.all[pump as usize].raise(&mut marking);
        }
        for (pump, marking) in before.iter().rev() {
            let times = self.pumps.all[*pump as usize].before(marking, demand)?;
            if times > 0 {
                word.push((Part::Pump(*pump), times));
            }
        }
        if let Some((_, transition)) = parent {
            for &(place, change) in self.pt.effects.of(transition) {
                let demand = &mut demand[place as usize];
                *demand = u64::try_from((i128::from(*demand) - i128::from(change)).max(0)).ok()?;
            }
            for &(place, tokens) in self.pt.needs.of(transition) {
                let demand = &mut demand[place as usize];
                *demand = u64::from(tokens).max(*demand);
            }
            word.push((Part::Transition(transition), 1));
        }
        Some(())
    }

    /// A sequence from the initial marking to at least so many tokens, by place, as a node has or
    /// has ω of. `None` when a number passes 63 bits.
    pub(super) fn sequence(&self, id: u32, mut demand: Vec<u64>, firings: u64) -> Option<Sequence> {
        let mut word = Word::new();
        let mut at = Some(id);
        while let Some(id) = at {
            let node = &self.nodes[id as usize];
            self.back(node.parent, self.raised_of(node), &mut demand, &mut word)?;
            at = node.parent.map(|it| it.0);
        }
        word.reverse();
        Some(self.pumps.sequence(&word, firings))
    }

    /// The first pump of a node, when no marking before has ω.
    pub(super) fn pumping(&self, id: u32, firings: u64) -> Option<Growth> {
        let node = &self.nodes[id as usize];
        let number = *self.raised_of(node).first()?;
        let pump = &self.pumps.all[number as usize];
        // The first marking that enables the pump will do.
        let mut stem = None;
        let mut at = node.parent;
        while let Some((id, _)) = at {
            stem = Some(id).filter(|&it| pump.is_enabled(self.marking(it))).or(stem);
            at = self.nodes[id as usize].parent;
        }
        let mut word = Word::new();
        let mut at = stem.map_or(node.parent, |it| self.nodes[it as usize].parent);
        while let Some((id, transition)) = at {
            word.push((Part::Transition(transition), 1));
            at = self.nodes[id as usize].parent;
        }
        word.reverse();
        let stem = self.pumps.sequence(&word, firings);
        let grows =
            pump.effects.iter().map(|&(place, by)| (PlaceId(place), by.unsigned_abs())).collect();
        Some(Growth {
            stem,
            pump: self.pumps.sequence(&vec![(Part::Pump(number), 1)], firings),
            grows,
        })
    }

    pub(super) fn marking(&self, id: u32) -> &[Tokens] {
        let places = self.pt.places.len();
        &self.markings[id as usize * places..][..places]
    }

    /// The numbers of the maximal markings, by marking.
    pub(super) fn maximal(&self) -> Vec<u32> {
        let mut ids = self.maximal.ids();
        ids.sort_by(|&one, &other| self.marking(one).cmp(self.marking(other)));
        ids
    }

    /// How many nodes there are.
    pub(super) fn nodes(&self) -> u64 {
        self.nodes.len() as u64
    }

    fn bytes(&self) -> u64 {
        self.nodes.len() as u64 * (self.pt.places.len() as u64 * 8 + 160)
            + self.raised.len() as u64 * 4
            + self.pumps.bytes
    }

    fn raised_of(&self, node: &Node) -> &[u32] {
        &self.raised[node.raised.start as usize..node.raised.end as usize]
    }
}
