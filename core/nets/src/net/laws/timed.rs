//! Moves of nets with intervals, in which time passes.

use super::cuts::Cuts;
use super::graph::{Graph, Limit, Move, NONE};
use super::moves::{IN_TIME, Moves, SHARED, TIME};
use super::zone::{DUE, Zone};
use crate::player::code::{self, Code, plus};

impl<const W: usize> Graph<W> {
    /// Fires the transition that is due: the first by priority, then by line, as clocks are sorted.
    pub(super) const fn due(
        &mut self,
        code: &Code<'_, W>,
        cuts: &Cuts,
        moves: &Moves,
        from: usize,
        zone: &Zone,
    ) {
        let (mut first, mut at) = (NONE, 0);
        while at < zone.count {
            if zone.until[at] == DUE {
                let by = code.clocks[zone.clocks[at] as usize].entry;
                if first == NONE {
                    first = by;
                } else if self.conflict.is_none() {
                    self.conflict = Some((from as u16, first, by));
                }
            }
            at += 1;
        }
        let delta = code.entries[first as usize].delta;
        let after = plus(&self.markings[from], &code.deltas[delta as usize]);
        if code.holds(&code.bounds, &after) {
            let way = Move { from, by: first, kind: IN_TIME, group: self.fired };
            self.fire(code, cuts, moves, &way, zone, &after);
        } else {
            self.overflows(from, first);
        }
    }

    /// A transition fires, or a shared place changes, in a net with intervals.
    pub(super) const fn fire(
        &mut self,
        code: &Code<'_, W>,
        cuts: &Cuts,
        moves: &Moves,
        way: &Move,
        zone: &Zone,
        after: &[u64; W],
    ) -> bool {
        let left = left(code, &self.markings[way.from], after, way.by);
        let own = if way.kind == SHARED { code::NONE } else { code.entries[way.by as usize].clock };
        let Some(mut zone) = zone.moved(code, cuts, &left, after, own) else {
            self.limit = Some(Limit::Clocks);
            return false;
        };
        if !zone.is_due() && moves.rests(code, after) {
            zone.delay();
        }
        self.enter(cuts, way, &zone, 0, after)
    }

    /// Time passes until some clocks begin a phase: for each choice of them the part of the zone
    /// where it is those. The clocks before `at` have been chosen from.
    pub(super) const fn pass(
        &mut self,
        code: &Code<'_, W>,
        cuts: &Cuts,
        way: &Move,
        zone: &Zone,
        at: usize,
        ending: u64,
    ) -> bool {
        if at == zone.count {
            if ending == 0 {
                return true;
            }
            let mut next = zone.next(code, cuts, ending);
            if !next.is_due() {
                next.delay();
            }
            let marking = self.markings[way.from];
            return self.enter(cuts, way, &next, 0, &marking);
        }
        if zone.until[at] < 0 {
            return self.pass(code, cuts, way, zone, at + 1, ending);
        }
        if let Some(part) = zone.ending(at, true)
            && !self.pass(code, cuts, way, &part, at + 1, ending | 1 << at)
        {
            return false;
        }
        match zone.ending(at, false) {
            Some(part) => self.pass(code, cuts, way, &part, at + 1, ending),
            None => true,
        }
    }

    /// Adds edges to the classes of a zone: one on either side of each cut, from this one on.
    const fn enter(
        &mut self,
        cuts: &Cuts,
        way: &Move,
        zone: &Zone,
        cut: usize,
        marking: &[u64; W],
    ) -> bool {
        if let Some((low, high, cut)) = zone.divided(cuts, cut) {
            return self.enter(cuts, way, &low, cut + 1, marking)
                && self.enter(cuts, way, &high, cut + 1, marking);
        }
        let to = self.reach(marking, zone, true, (way.from as u16, way.by));
        self.add(way, to)
    }

    /// How many markings there are, and how many ways from one to another by a transition or by a
    /// change of a shared place.
    pub(super) const fn sizes(&self) -> (usize, usize) {
        if self.pooled == 0 {
            return (self.count, self.fired);
        }
        let (mut markings, mut firings) = (0, 0);
        let mut class = 0;
        while class < self.count {
            markings += (self.same[class] == NONE) as usize;
            class += 1;
        }
        let mut at = 0;
        while at < self.fired {
            let it = &self.firings[at];
            let mut new = it.kind != TIME && it.group as usize == at;
            let mut class = self.same[it.from as usize];
            while new && class != NONE {
                let mut other = self.starts[class as usize] as usize;
                while new && other < self.starts[class as usize + 1] as usize {
                    new = self.firings[other].by != it.by;
                    other += 1;
                }
                class = self.same[class as usize];
            }
            firings += new as usize;
            at += 1;
        }
        (markings, firings)
    }
}

/// Returns the marking left when a transition, or a change of a shared place, has taken its tokens.
pub(super) const fn left<const W: usize>(
    code: &Code<'_, W>,
    marking: &[u64; W],
    after: &[u64; W],
    by: u16,
) -> [u64; W] {
    let mut left = *marking;
    if (by as usize) < code.entries.len() {
        let take = &code.takes[code.entries[by as usize].transition as usize];
        let mut word = 0;
        while word < W {
            left[word] -= take[word];
            word += 1;
        }
    } else {
        // One token moves between a place and its complement.
        let mut at = 0;
        while at < code.fields.len() {
            let field = code.fields[at];
            if field.of(after) < field.of(marking) {
                left[field.word as usize] -= field.tokens(1);
            }
            at += 1;
        }
    }
    left
}
