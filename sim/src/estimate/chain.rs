//! The markings that runs have come to, and where each transition leads from there.
//!
//! Runs come to the same markings again and again. What a marking decides, what is enabled in it,
//! and where a transition leads from it is found out once; from then on a step is a draw and a
//! look. When that takes too much memory, no more is remembered: a run that leaves what is known
//! walks on by itself. What is found does not depend on what is remembered: transitions are always
//! in the order of the net.

use super::path::{Asked, Judged};
use super::tally::{Overflow, Tally, Witness};
use super::walk::Walk;
use crate::streams::{Stream, split_mix};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;

/// Budget of the memory of markings, in bytes.
const BYTES: usize = 64 << 20;

/// Nowhere yet.
const UNKNOWN: u32 = u32::MAX;

/// One run to be drawn.
pub(super) struct Run {
    pub(super) number: u64,
    pub(super) most: u64,
    pub(super) stream: Stream,
}

/// A transition that is enabled, and the marking that it leads to.
#[derive(Clone, Copy)]
struct Edge {
    transition: u32,
    to: u32,
}

/// The position of a run.
#[derive(Clone, Copy)]
enum At {
    /// A marking that is remembered.
    Known(u32),
    /// Another one, that of the walk.
    Beyond,
}

pub(super) struct Chain<'n> {
    net: &'n Pt,
    asked: &'n [Asked<'n>],
    bytes: usize,
    /// Summand of a token in each place in the hash of a marking.
    weights: Vec<u64>,
    /// One marking after the other; that of the start is the first.
    markings: Vec<u32>,
    hashes: Vec<u64>,
    /// Judgement of each marking on each question.
    judged: Vec<Judged>,
    /// Start of the edges of each marking, and at last their number.
    first: Vec<u32>,
    edges: Vec<Edge>,
    /// Markings by their hash; a power of two of them.
    table: Vec<u32>,
    marking: Vec<u32>,
    /// A bit for each transition.
    enabled: Vec<u64>,
    /// How runs go on among markings that are not remembered.
    walk: Walk<'n>,
}

impl<'n> Chain<'n> {
    pub(super) fn new(net: &'n Pt, asked: &'n [Asked<'n>]) -> Self {
        Self::within(net, asked, BYTES)
    }

    fn within(net: &'n Pt, asked: &'n [Asked<'n>], bytes: usize) -> Self {
        let mut mixer = 0;
        let mut chain = Self {
            net,
            asked,
            bytes,
            weights: net.places.iter().map(|_| split_mix(&mut mixer)).collect(),
            markings: Vec::new(),
            hashes: Vec::new(),
            judged: Vec::new(),
            first: vec![0],
            edges: Vec::new(),
            table: vec![UNKNOWN; 16],
            marking: net.initial.clone(),
            enabled: vec![0; net.transitions.len().div_ceil(64)],
            walk: Walk::new(net),
        };
        for transition in 0..net.transitions.len() as u32 {
            if net.enabled(&net.initial, transition) {
                chain.enabled[transition as usize / 64] |= 1 << (transition % 64);
            }
        }
        let tokens = net.initial.iter().zip(&chain.weights);
        let hash = tokens.fold(0_u64, |hash, (tokens, weight)| {
            hash.wrapping_add(u64::from(*tokens).wrapping_mul(*weight))
        });
        chain.add(hash);
        chain
    }

    /// Draws a run from the start and counts what it shows; how many transitions fired.
    pub(super) fn run(
        &mut self,
        run: Run,
        open: &mut Vec<usize>,
        tallies: &mut [Tally],
    ) -> Result<u64, Overflow> {
        let Run { number, most, mut stream } = run;
        let (mut at, mut steps) = (At::Known(0), 0);
        open.clear();
        open.extend(0..self.asked.len());
        loop {
            open.retain(|&question| {
                let judged = self.judged(at, question);
                if judged != Judged::Open {
                    let seen = Witness { steps, run: number };
                    tallies[question].add(&self.asked[question], judged, seen);
                }
                judged == Judged::Open
            });
            if open.is_empty() || steps == most {
                break;
            }
            match self.step(at, &mut stream) {
                None => break,
                Some(Ok((_, next))) => at = next,
                Some(Err(error)) => return Err(Overflow { run: number, ..error }),
            }
            steps += 1;
        }
        for &question in &*open {
            let seen = Witness { steps, run: number };
            tallies[question].add(&self.asked[question], Judged::Open, seen);
        }
        Ok(steps)
    }

    /// Returns the firings of a run, until it has so many steps.
    pub(super) fn fired(&mut self, mut run: Run) -> Vec<TransitionId> {
        let (mut at, mut fired) = (At::Known(0), Vec::new());
        while (fired.len() as u64) < run.most
            && let Some(Ok((transition, next))) = self.step(at, &mut run.stream)
        {
            fired.push(TransitionId(transition));
            at = next;
        }
        fired
    }

    /// Returns the judgement of the marking on a question.
    #[inline]
    fn judged(&self, at: At, question: usize) -> Judged {
        match at {
            At::Known(at) => self.judged[at as usize * self.asked.len() + question],
            At::Beyond => self.asked[question].sees(self.walk.marking(), self.walk.is_dead()),
        }
    }

    /// Fires one of the transitions that are enabled, all equally likely, and comes to another
    /// marking; none in a deadlock.
    #[inline]
    fn step(&mut self, at: At, stream: &mut Stream) -> Option<Result<(u32, At), Overflow>> {
        let At::Known(at) = at else {
            return Some(self.walk.step(stream)?.map(|transition| (transition, At::Beyond)));
        };
        let [first, end] = [0, 1].map(|it| self.first[at as usize + it] as usize);
        if first == end {
            return None;
        }
        let chosen = first + stream.below((end - first) as u64) as usize;
        let Edge { transition, to } = self.edges[chosen];
        if to != UNKNOWN {
            return Some(Ok((transition, At::Known(to))));
        }
        let to = self.lead(at, chosen).map_err(|place| Overflow {
            run: 0,
            transition: TransitionId(transition),
            place: PlaceId(place),
        });
        Some(to.map(|to| (transition, to)))
    }

    /// Returns the target of an edge that was never taken, or the place that would overflow.
    fn lead(&mut self, at: u32, chosen: usize) -> Result<At, u32> {
        let places = self.net.places.len();
        let from = at as usize * places;
        self.marking.copy_from_slice(&self.markings[from..from + places]);
        let mut hash = self.hashes[at as usize];
        let effects = self.net.effects.of(self.edges[chosen].transition);
        for &(place, change) in effects {
            let tokens = &mut self.marking[place as usize];
            *tokens = u32::try_from(i64::from(*tokens) + change).map_err(|_| place)?;
            let weight = self.weights[place as usize];
            hash = hash.wrapping_add(change.cast_unsigned().wrapping_mul(weight));
        }
        if let Some(known) = self.find(hash) {
            self.edges[chosen].to = known;
            return Ok(At::Known(known));
        }
        if self.is_full() {
            self.walk.begin(&self.marking);
            return Ok(At::Beyond);
        }
        // The enabled transitions change only where a place of the effects comes to or falls below
        // the need of a transition.
        self.enabled.fill(0);
        for edge in self.first[at as usize]..self.first[at as usize + 1] {
            let it = self.edges[edge as usize].transition;
            self.enabled[it as usize / 64] |= 1 << (it % 64);
        }
        for &(place, _) in effects {
            let before = self.markings[from + place as usize];
            let after = self.marking[place as usize];
            for &(it, need) in self.net.consumers.of(place) {
                let word = &mut self.enabled[it as usize / 64];
                if after < need {
                    *word &= !(1 << (it % 64));
                } else if before < need && self.net.enabled(&self.marking, it) {
                    *word |= 1 << (it % 64);
                }
            }
        }
        let to = self.add(hash);
        self.edges[chosen].to = to;
        Ok(At::Known(to))
    }

    /// The marking that was met before.
    fn find(&self, hash: u64) -> Option<u32> {
        let (mask, places) = (self.table.len() - 1, self.marking.len());
        let mut slot = hash as usize & mask;
        loop {
            let id = self.table[slot];
            if id == UNKNOWN {
                return None;
            }
            let same = self.hashes[id as usize] == hash
                && self.markings[id as usize * places..][..places] == self.marking[..];
            if same {
                return Some(id);
            }
            slot = (slot + 1) & mask;
        }
    }

    /// Remembers a marking and what is enabled in it.
    fn add(&mut self, hash: u64) -> u32 {
        let id = self.hashes.len() as u32;
        self.markings.extend_from_slice(&self.marking);
        self.hashes.push(hash);
        for (word, base) in self.enabled.iter().zip((0_u32..).step_by(64)) {
            let mut left = *word;
            while left != 0 {
                let transition = base + left.trailing_zeros();
                self.edges.push(Edge { transition, to: UNKNOWN });
                left &= left - 1;
            }
        }
        let is_dead = self.first.last().copied() == Some(self.edges.len() as u32);
        self.first.push(self.edges.len() as u32);
        self.judged.extend(self.asked.iter().map(|it| it.sees(&self.marking, is_dead)));
        if self.hashes.len() * 2 > self.table.len() {
            self.table = vec![UNKNOWN; self.table.len() * 2];
            (0..=id).for_each(|it| self.enter(it));
        } else {
            self.enter(id);
        }
        id
    }

    fn enter(&mut self, id: u32) {
        let mask = self.table.len() - 1;
        let mut slot = self.hashes[id as usize] as usize & mask;
        while self.table[slot] != UNKNOWN {
            slot = (slot + 1) & mask;
        }
        self.table[slot] = id;
    }

    fn is_full(&self) -> bool {
        let bytes = size_of_val(&self.markings[..])
            + size_of_val(&self.edges[..])
            + size_of_val(&self.table[..])
            + self.hashes.len() * (size_of::<u64>() + size_of::<u32>() + self.asked.len());
        bytes > self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::Streams;
    use cotama_models::nets::families::philosophers;
    use cotama_property::parse;

    /// Little memory is as good as much, if slower.
    #[test]
    fn markings_beyond_the_memory_are_walked() {
        let net = Pt::from(&philosophers(4).unwrap().view().net());
        let question = parse("EF deadlock", &net).unwrap().question;
        let asked = [Asked::new(question.formula().unwrap(), &net).unwrap()];
        let found = |bytes: usize| {
            let mut chain = Chain::within(&net, &asked, bytes);
            let (mut tallies, mut open, mut steps) = ([Tally::default()], Vec::new(), 0);
            for number in 0..300 {
                let stream = Streams::new(2).stream(&number.to_string());
                let run = Run { number, most: 60, stream };
                steps += chain.run(run, &mut open, &mut tallies).unwrap();
            }
            (tallies, steps, chain.hashes.len())
        };
        let (much, little) = (found(BYTES), found(2_000));
        assert_eq!((much.0, much.1), (little.0, little.1));
        assert!(much.2 == 81 && little.2 < 20, "{} and {}", much.2, little.2);
    }
}
