//! Whether bounds hold, and whether what fires by itself without time passing comes to an end.

use super::graph::{Graph, MARKINGS, NONE};
use super::judge::{Culprit, Violation};
use super::moves::{AT_ONCE, IN_TIME, id};
use super::way::{held, step};
use crate::net::data::{Net, PlaceId};
use crate::player::code::{Code, plus};

impl<const W: usize> Graph<W> {
    /// The most transitions without event and interval that fire one after another.
    ///
    /// # Errors
    /// When a bound is exceeded, when not all was explored, or when transitions fire by themselves
    /// for ever without time passing.
    pub const fn settles<'n>(
        &self,
        net: &Net<'n>,
        code: &Code<'_, W>,
    ) -> Result<u32, Violation<'n, W>> {
        if let Some((from, by)) = self.overflow {
            return Err(self.exceeds(net, code, from as usize, by));
        }
        if let Some(limit) = self.limit {
            return Err(Violation::too_large(limit, None));
        }
        // How many moves leave a class that passes to one that is not known to settle.
        let mut open = [0_u16; MARKINGS];
        let mut any = false;
        let mut firing = 0;
        while firing < self.fired {
            if matches!(self.firings[firing].kind, AT_ONCE | IN_TIME) {
                open[self.firings[firing].from as usize] += 1;
                any = true;
            }
            firing += 1;
        }
        if !any {
            return Ok(0);
        }
        let mut queue = [0_u16; MARKINGS];
        let mut settled = 0;
        let mut class = 0;
        while class < self.count {
            if open[class] == 0 {
                queue[settled] = class as u16;
                settled += 1;
            }
            class += 1;
        }
        let mut depths = [0_u32; MARKINGS];
        let (mut most, mut next) = (0, 0);
        while next < settled {
            let to = queue[next] as usize;
            let mut firing = self.arrivals[to];
            while firing != NONE {
                let it = &self.firings[firing as usize];
                if matches!(it.kind, AT_ONCE | IN_TIME) {
                    let from = it.from as usize;
                    if it.kind == AT_ONCE && depths[from] <= depths[to] {
                        depths[from] = depths[to] + 1;
                        most = if depths[from] > most { depths[from] } else { most };
                    }
                    open[from] -= 1;
                    if open[from] == 0 {
                        queue[settled] = it.from;
                        settled += 1;
                    }
                }
                firing = self.earlier[firing as usize];
            }
            next += 1;
        }
        if settled < self.count { Err(self.endless(net, code, &open)) } else { Ok(most) }
    }

    const fn exceeds<'n>(
        &self,
        net: &Net<'n>,
        code: &Code<'_, W>,
        from: usize,
        by: u16,
    ) -> Violation<'n, W> {
        let entry = &code.entries[by as usize];
        let after = plus(&self.markings[from], &code.deltas[entry.delta as usize]);
        let mut at = 0;
        while held(code, &after, at) <= net.places[at].bound as u64 {
            at += 1;
        }
        let (mut plain, mut word) = (code.clocks.is_empty() && self.conflict.is_none(), 0);
        while word < W {
            plain = plain && code.restless[word] == 0;
            word += 1;
        }
        let mut way = self.way(net, code, from);
        way.add(step(net, code, by));
        let culprit = Culprit::Bound {
            place: PlaceId(at as u32),
            tokens: held(code, &after, at),
            transition: id(code, by),
            // Monotone: more tokens only enable more, and nothing else goes first.
            grows: plain && self.grows(from, &after, code),
        };
        Violation { law: None, culprit, way, marking: self.markings[from] }
    }

    /// In the open classes transitions fire by themselves for ever.
    const fn endless<'n>(
        &self,
        net: &Net<'n>,
        code: &Code<'_, W>,
        open: &[u16; MARKINGS],
    ) -> Violation<'n, W> {
        let mut at = 0;
        while open[at] == 0 {
            at += 1;
        }
        // Step until a class comes back; once round from there, what is nearest to the start.
        let mut seen = [false; MARKINGS];
        while !seen[at] {
            seen[at] = true;
            at = self.firings[self.onwards(at, open)].to as usize;
        }
        let (mut start, end) = (at, at);
        let mut repeats = 0;
        loop {
            at = self.firings[self.onwards(at, open)].to as usize;
            start = if at < start { at } else { start };
            repeats += 1;
            if at == end {
                break;
            }
        }
        let mut way = self.way(net, code, start);
        at = start;
        loop {
            let firing = &self.firings[self.onwards(at, open)];
            way.add(step(net, code, firing.by));
            at = firing.to as usize;
            if at == start {
                let culprit = Culprit::Forever { repeats };
                return Violation { law: None, culprit, way, marking: self.markings[start] };
            }
        }
    }

    /// The first move that stays among the open classes.
    const fn onwards(&self, class: usize, open: &[u16; MARKINGS]) -> usize {
        let mut firing = self.starts[class] as usize;
        while open[self.firings[firing].to as usize] == 0 {
            firing += 1;
        }
        firing
    }
}
