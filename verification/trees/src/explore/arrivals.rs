//! Edges of a point: where its replies lead, looked up together.
//!
//! A large exploration waits most of its time for the table of keys, which fits into no cache. So
//! the keys of all replies are made first, and their places in the table read one after the
//! other: these reads wait at the same time.

use super::graph::{Edge, End, MAX_SEQUENCES, WAKES, code};
use super::{Seen, Space};
use crate::machine::{Reply, Stop, Thrown};
use crate::tree::Answer;
use std::collections::VecDeque;

/// An edge whose target is not looked up yet.
struct Arrival {
    reply: Option<Reply>,
    what: u32,
    level: u32,
    events: u32,
    wakes: bool,
    /// Target, where it is an end that was met before.
    known: Option<u32>,
    thrown: Option<Thrown>,
}

/// Edges of one point, and the keys of their targets.
#[derive(Default)]
pub(super) struct Arrivals {
    list: Vec<Arrival>,
    keys: Vec<u64>,
}

impl Space<'_> {
    /// Notes where a tick has stopped.
    pub(super) fn arrive(&mut self, from: usize, reply: Option<Reply>, stop: Stop) {
        let asks = self.asks();
        let ticks = self.level[from] + 1;
        let (what, level) = match &stop {
            Stop::Asked(question) => (question.node as u32 + 1, ticks - 1),
            Stop::Answered(Answer::Running) => (0, ticks),
            Stop::Answered(Answer::Success) => (asks + 1, ticks),
            Stop::Answered(Answer::Failure) => (asks + 2, ticks),
            Stop::Answered(Answer::Skipped) => (asks + 3, ticks),
            Stop::Halted => (asks + 5 + self.tree.nodes.len() as u32, ticks),
            Stop::Thrown(thrown) => (asks + 4 + thrown.node.map_or(0, |it| it as u32 + 1), ticks),
        };
        let wakes = what == 0 && self.machine.wake;
        let edge = (self.edges.len() + self.arrivals.list.len()) as u32;
        let seen = Seen { ticks, node: from as u32, edge };
        for (child, node) in std::mem::take(&mut self.machine.lost) {
            self.lost.entry((child as usize, node as usize)).or_insert(seen);
        }
        for it in std::mem::take(&mut self.machine.refused) {
            self.refused.entry((it.node, it.part)).or_insert((it, seen));
        }
        for (node, other) in std::mem::take(&mut self.machine.begun) {
            self.overlap.entry((node as usize, other as usize)).or_insert(seen);
        }
        let events = self.sequences.number(&self.machine.events);
        // Ends are few, and met by a third of all edges.
        let end = (what > asks).then(|| (what - asks) as usize);
        let known = end.and_then(|it| self.ends.get(it).copied().flatten());
        if known.is_none() {
            if end.is_some() {
                self.pack.leave(&mut self.machine);
            }
            self.machine.wake &= (1..=asks).contains(&what);
            self.pack.store(&mut self.machine, what);
            self.arrivals.keys.extend_from_slice(&self.pack.key);
        }
        let thrown = match stop {
            Stop::Thrown(it) => Some(it),
            _ => None,
        };
        self.arrivals.list.push(Arrival { reply, what, level, events, wakes, known, thrown });
    }

    /// Adds the edges to where the replies to a question have led, and looks at what is new there.
    pub(super) fn settle(
        &mut self,
        from: usize,
        waiting: &mut VecDeque<u32>,
        work: &mut VecDeque<u32>,
    ) {
        let asks = self.asks();
        let Arrivals { mut list, mut keys } = std::mem::take(&mut self.arrivals);
        let words = self.pack.words;
        self.keys.expect(&keys);
        let mut at = 0;
        for it in list.drain(..) {
            let edge = self.edges.len() as u32;
            let (target, new) = if let Some(known) = it.known {
                (known, false)
            } else {
                let (target, new) = self.keys.insert(&keys[at..at + words]);
                at += words;
                if new {
                    self.add(it.what, (from as u32, edge), it.level);
                }
                (target, new)
            };
            debug_assert!((target as usize) < self.level.len(), "an edge leads to a point");
            debug_assert!(it.events < MAX_SEQUENCES && code(it.reply) < WAKES);
            let rest = it.events << 8 | code(it.reply) | if it.wakes { WAKES } else { 0 };
            self.edges.push(Edge { target, rest });
            self.count[from] += 1;
            if !new {
                continue;
            }
            let seen = Seen { ticks: self.level[from] + 1, node: from as u32, edge };
            if it.what > asks {
                if !self.pack.watches {
                    let end = (it.what - asks) as usize;
                    self.ends.resize(self.ends.len().max(end + 1), None);
                    self.ends[end] = Some(target);
                }
                if let Some(thrown) = it.thrown {
                    self.causes.entry(End::Thrown(thrown.node)).or_insert(thrown.why);
                }
                continue;
            }
            self.pack.load(&keys[at - words..at], &mut self.machine);
            if let Some(question) = self.machine.question() {
                work.push_back(target);
                self.look_at_question(question, seen);
            } else {
                waiting.push_back(target);
                self.look_at_state(seen);
            }
        }
        keys.clear();
        self.arrivals = Arrivals { list, keys };
    }

    /// Adds the state of a fresh tree.
    pub(super) fn begin(&mut self) {
        self.keys.insert(&self.pack.key);
        self.add(0, (0, 0), 0);
    }

    fn add(&mut self, what: u32, via: (u32, u32), level: u32) {
        self.what.push(what);
        self.level.push(level);
        self.via.push(via);
        self.first.push(0);
        self.count.push(0);
    }
}
