//! Everything that a [`Player`](crate::net::Player) of a small net can do, explored while
//! compiling.
//!
//! A *class* is a marking and what the clocks can show there, a [`Zone`]; without intervals it is
//! the marking alone. A class *passes* where a transition fires by itself now: the first one that
//! is enabled without event and interval, else the first one that is due. All others *rest*. There,
//! at any instant, each event makes the first transition fire that is enabled and open, or the
//! places that the net shares with others change; or time passes until an interval begins, ends or
//! is due. Breadth first, so the path to a class is a shortest one.

use super::cuts::Cuts;
use super::moves::{AT_ONCE, FIRINGS, IN_TIME, Moves, SHARED, TIME, changed};
use super::zone::Zone;
use crate::net::data::Net;
use crate::player::code::{self, Code};

/// The most classes that are explored while compiling; in a net without intervals, markings.
pub const MARKINGS: usize = 1_024;
const SLOTS: usize = 4 * MARKINGS;
/// The most numbers in all zones.
const NUMBERS: usize = 32 * MARKINGS;
/// No class, or no move.
pub(super) const NONE: u16 = u16::MAX;

/// An edge from one class to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Firing {
    pub(super) from: u16,
    pub(super) to: u16,
    /// The move: an entry, or beyond them a change of a shared place, or [`TIME`].
    pub(super) by: u16,
    /// The event, or [`AT_ONCE`], [`IN_TIME`], [`SHARED`] or [`TIME`].
    pub(super) kind: u16,
    /// The first edge of the same move from there: to which of them it leads depends on the clocks.
    pub(super) group: u16,
}

/// A limit that a net passes while it is explored at compile time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Transitions, places and events.
    Parts,
    /// Markings, or classes of markings and clocks.
    Classes,
    /// Moves between them.
    Moves,
    /// Transitions with an interval that are enabled together.
    Clocks,
    /// Numbers that tell what clocks show.
    Numbers,
}

/// The classes of a small net, and the moves between them.
///
/// An interpreter evaluates what makes it, and calls cost it most: without intervals, the inner
/// loops call nothing.
#[derive(Clone, Copy, Debug)]
pub struct Graph<const W: usize> {
    pub(super) markings: [[u64; W]; MARKINGS],
    pub(super) count: usize,
    /// Start of the zone of each class in the pool.
    zones: [u32; MARKINGS],
    pool: [i64; NUMBERS],
    pub(super) pooled: usize,
    /// Another class with the same marking; [`NONE`] when there was none.
    pub(super) same: [u16; MARKINGS],
    /// How each class was first reached: from which, and by which move.
    pub(super) parents: [(u16, u16); MARKINGS],
    /// Start of the moves of each class.
    pub(super) starts: [u16; MARKINGS + 1],
    pub(super) firings: [Firing; FIRINGS],
    pub(super) fired: usize,
    /// The last move to each class; [`NONE`] when there is none.
    pub(super) arrivals: [u16; MARKINGS],
    /// The move before each one to the same class.
    pub(super) earlier: [u16; FIRINGS],
    slots: [u16; SLOTS],
    /// Why not all was explored.
    pub(super) limit: Option<Limit>,
    /// A transition that exceeds a bound: from which class, which entry.
    pub(super) overflow: Option<(u16, u16)>,
    /// Two transitions between which priorities or the order of lines decide: in which class, which
    /// entries.
    pub(super) conflict: Option<(u16, u16, u16)>,
}

impl<const W: usize> Graph<W> {
    /// Explores a net.
    pub const fn of(net: &Net<'_>, code: &Code<'_, W>) -> Self {
        Self::with(net, code, &Cuts::NONE)
    }

    /// Explores a net, with zones cut.
    pub(super) const fn with(net: &Net<'_>, code: &Code<'_, W>, cuts: &Cuts) -> Self {
        let mut graph = Self {
            markings: [[0; W]; MARKINGS],
            count: 0,
            zones: [0; MARKINGS],
            pool: [0; NUMBERS],
            pooled: 0,
            same: [NONE; MARKINGS],
            parents: [(NONE, NONE); MARKINGS],
            starts: [0; MARKINGS + 1],
            firings: [Firing { from: 0, to: 0, by: 0, kind: 0, group: 0 }; FIRINGS],
            fired: 0,
            arrivals: [NONE; MARKINGS],
            earlier: [NONE; FIRINGS],
            slots: [NONE; SLOTS],
            limit: None,
            overflow: None,
            conflict: None,
        };
        // The graph and the moves are local: an interpreter follows each reference anew.
        let Some(moves) = Moves::of(net, code) else {
            graph.limit = Some(Limit::Parts);
            return graph;
        };
        let timed = !code.clocks.is_empty();
        let start = (NONE, NONE);
        if timed {
            // All clocks begin now.
            let none = [0; W];
            match Zone::EMPTY.moved(code, cuts, &none, &code.initial, code::NONE) {
                Some(mut zone) => {
                    if !zone.is_due() && moves.rests(code, &code.initial) {
                        zone.delay();
                    }
                    graph.reach(&code.initial, &zone, true, start);
                }
                None => graph.limit = Some(Limit::Clocks),
            }
        } else {
            graph.reach(&code.initial, &Zone::EMPTY, false, start);
        }
        // In which class each event was last answered.
        let mut answered = [NONE; FIRINGS];
        let mut from = 0;
        while from < graph.count {
            let marking = graph.markings[from];
            let zone = if timed { graph.zone(from) } else { Zone::EMPTY };
            let due = timed && zone.is_due();
            let mut at_once = false;
            let mut at = 0;
            // Transitions that fire at once by themselves come first, and then nothing else
            // happens.
            let mut end = if due { moves.at_once } else { moves.count };
            while at < end {
                let (by, kind) = (moves.by[at], moves.kind[at]);
                at += 1;
                let after = if kind == SHARED {
                    match changed(net, code, &marking, by as usize) {
                        Some(after) => after,
                        None => continue,
                    }
                } else {
                    // As `Code::holds` and `Code::after`: no field borrows from another, so nothing
                    // wraps.
                    let entry = &code.entries[by as usize];
                    let need = &code.needs[entry.need as usize];
                    let mut word = 0;
                    while word < W
                        && ((marking[word] | code.guards[word]) - need[word]) & code.guards[word]
                            == code.guards[word]
                    {
                        word += 1;
                    }
                    if word < W || entry.clock != code::NONE && !zone.opens(code, entry.clock) {
                        continue;
                    }
                    // The first one fires, and no other.
                    let late;
                    if kind == AT_ONCE {
                        late = at_once;
                        at_once = true;
                        end = moves.at_once;
                    } else {
                        late = answered[kind as usize] as usize == from;
                        answered[kind as usize] = from as u16;
                    }
                    if late {
                        graph.conflicts(from, by, kind);
                        continue;
                    }
                    let delta = &code.deltas[entry.delta as usize];
                    let mut after = marking;
                    let mut fits = true;
                    word = 0;
                    while word < W {
                        after[word] = (marking[word] as u128 + delta[word] as u128) as u64;
                        let guards = code.guards[word];
                        fits =
                            fits && ((code.bounds[word] | guards) - after[word]) & guards == guards;
                        word += 1;
                    }
                    if !fits {
                        graph.overflows(from, by);
                        continue;
                    }
                    after
                };
                if timed {
                    let way = Move { from, by, kind, group: graph.fired };
                    if !graph.fire(code, cuts, &moves, &way, &zone, &after) {
                        return graph;
                    }
                    continue;
                }
                let Some(to) = graph.reach(&after, &zone, false, (from as u16, by)) else {
                    return graph;
                };
                if graph.fired == FIRINGS {
                    graph.limit = Some(Limit::Moves);
                    return graph;
                }
                let group = graph.fired as u16;
                graph.firings[graph.fired] = Firing { from: from as u16, to, by, kind, group };
                graph.earlier[graph.fired] = graph.arrivals[to as usize];
                graph.arrivals[to as usize] = group;
                graph.fired += 1;
            }
            if due && !at_once {
                graph.due(code, cuts, &moves, from, &zone);
            } else if timed && !at_once && zone.runs() {
                let way = Move { from, by: TIME, kind: TIME, group: graph.fired };
                graph.pass(code, cuts, &way, &zone, 0, 0);
            }
            if graph.limit.is_some() || graph.overflow.is_some() {
                return graph;
            }
            from += 1;
            graph.starts[from] = graph.fired as u16;
        }
        graph
    }

    /// Two transitions could fire, and only one does; this is the other one.
    const fn conflicts(&mut self, from: usize, by: u16, kind: u16) {
        let mut at = self.starts[from] as usize;
        while self.conflict.is_none() && at < self.fired {
            if self.firings[at].kind == kind {
                self.conflict = Some((from as u16, self.firings[at].by, by));
            }
            at += 1;
        }
    }

    pub(super) const fn overflows(&mut self, from: usize, by: u16) {
        if self.overflow.is_none() {
            self.overflow = Some((from as u16, by));
        }
    }

    /// Adds an edge; whether there was room.
    pub(super) const fn add(&mut self, way: &Move, to: Option<u16>) -> bool {
        let Some(to) = to else { return false };
        if self.fired == FIRINGS {
            self.limit = Some(Limit::Moves);
            return false;
        }
        let Move { from, by, kind, group } = *way;
        self.firings[self.fired] = Firing { from: from as u16, to, by, kind, group: group as u16 };
        self.earlier[self.fired] = self.arrivals[to as usize];
        self.arrivals[to as usize] = self.fired as u16;
        self.fired += 1;
        true
    }

    /// The number of a class that has this marking and includes this zone; `None` when it is new
    /// and there is no room for it.
    pub(super) const fn reach(
        &mut self,
        marking: &[u64; W],
        zone: &Zone,
        timed: bool,
        parent: (u16, u16),
    ) -> Option<u16> {
        let mut hash = 0_u64;
        let mut word = 0;
        while word < W {
            // Multiplied without a call: the product of two words fits.
            hash = ((hash ^ marking[word]) as u128 * 0x9E37_79B9_7F4A_7C15) as u64;
            hash ^= hash >> 29;
            word += 1;
        }
        let mut slot = hash as usize % SLOTS;
        let mut same = NONE;
        while self.slots[slot] != NONE {
            let known = self.slots[slot];
            let mut word = 0;
            while word < W && self.markings[known as usize][word] == marking[word] {
                word += 1;
            }
            if word == W {
                if !timed || zone.is_in(&self.pool, self.zones[known as usize] as usize) {
                    return Some(known);
                }
                same = known;
            }
            slot = (slot + 1) % SLOTS;
        }
        if self.count == MARKINGS {
            self.limit = Some(Limit::Classes);
            return None;
        }
        if timed {
            let pooled = self.pooled + Zone::length(zone.count);
            if pooled > NUMBERS {
                self.limit = Some(Limit::Numbers);
                return None;
            }
            zone.write(&mut self.pool, self.pooled);
            self.zones[self.count] = self.pooled as u32;
            self.same[self.count] = same;
            self.pooled = pooled;
        }
        let number = self.count as u16;
        self.slots[slot] = number;
        self.markings[self.count] = *marking;
        self.parents[self.count] = parent;
        self.count += 1;
        Some(number)
    }

    /// How many classes were explored.
    pub const fn classes(&self) -> usize {
        self.count
    }

    /// Returns the zone of a class.
    pub(super) const fn zone(&self, class: usize) -> Zone {
        Zone::read(&self.pool, self.zones[class] as usize)
    }

    /// Whether nothing fires by itself now in a class.
    pub(super) const fn rests(&self, class: usize) -> bool {
        let first = self.starts[class];
        first == self.starts[class + 1]
            || !matches!(self.firings[first as usize].kind, AT_ONCE | IN_TIME)
    }
}

/// A move from a class.
pub(super) struct Move {
    pub(super) from: usize,
    pub(super) by: u16,
    pub(super) kind: u16,
    pub(super) group: usize,
}
