//! From where a place can always be marked.
//!
//! Some points of a class can have another future than others: what time brings first depends on
//! the clocks. A class *surely* leads to the place when it has a move all of whose outcomes do; it
//! *perhaps* does when it has a path. Where all classes surely do, the law holds; where one does
//! not even perhaps, it does not; else classes are cut, where their future parts, and explored
//! again.

use super::cuts::Cuts;
use super::graph::{Graph, Limit, MARKINGS, NONE};
use super::judge::{Culprit, Violation};
use super::moves::FIRINGS;
use crate::net::data::{Law, Net, PlaceId};
use crate::player::code::Code;

impl<const W: usize> Graph<W> {
    pub(super) const fn cannot<'n>(
        &self,
        net: &Net<'n>,
        code: &Code<'_, W>,
        law: &Law<'n>,
        place: PlaceId,
    ) -> Option<Violation<'n, W>> {
        let perhaps = self.leading(code, place, false);
        if let Some(class) = self.left_out(&perhaps) {
            let culprit = Culprit::Never { markings: self.sizes().0 };
            return Some(self.violation(net, code, law, class, culprit));
        }
        if code.clocks.is_empty() {
            return None;
        }
        let mut surely = self.leading(code, place, true);
        if self.left_out(&surely).is_none() {
            return None;
        }
        let mut cuts = Cuts::NONE;
        let mut cut = self.refine(&surely, &mut cuts);
        while cut && !cuts.full {
            let graph = Self::with(net, code, &cuts);
            if let Some(limit) = graph.limit {
                return Some(Violation::too_large(limit, Some(*law)));
            }
            let perhaps = graph.leading(code, place, false);
            if let Some(class) = graph.left_out(&perhaps) {
                let culprit = Culprit::Never { markings: self.sizes().0 };
                return Some(graph.violation(net, code, law, class, culprit));
            }
            surely = graph.leading(code, place, true);
            if graph.left_out(&surely).is_none() {
                return None;
            }
            cut = graph.refine(&surely, &mut cuts);
        }
        Some(Violation::too_large(Limit::Numbers, Some(*law)))
    }

    /// The first class that rests and is not among these.
    pub(super) const fn left_out(&self, among: &[bool; MARKINGS]) -> Option<usize> {
        let mut class = 0;
        while class < self.count {
            if !among[class] && self.rests(class) {
                return Some(class);
            }
            class += 1;
        }
        None
    }

    /// The classes that lead to the place, surely or perhaps: backwards from where it is marked.
    pub(super) const fn leading(
        &self,
        code: &Code<'_, W>,
        place: PlaceId,
        surely: bool,
    ) -> [bool; MARKINGS] {
        // How many outcomes of each move are open.
        let mut open = [0_u16; FIRINGS];
        let mut firing = 0;
        while surely && firing < self.fired {
            open[self.firings[firing].group as usize] += 1;
            firing += 1;
        }
        let mut leads = [false; MARKINGS];
        let mut queue = [0_u16; MARKINGS];
        let mut found = 0;
        let mut class = 0;
        while class < self.count {
            if self.tokens(code, place, class) > 0 {
                leads[class] = true;
                queue[found] = class as u16;
                found += 1;
            }
            class += 1;
        }
        let mut next = 0;
        while next < found {
            let mut firing = self.arrivals[queue[next] as usize];
            while firing != NONE {
                let it = &self.firings[firing as usize];
                let from = it.from as usize;
                let mut all = true;
                if surely {
                    open[it.group as usize] -= 1;
                    all = open[it.group as usize] == 0;
                }
                if all && !leads[from] {
                    leads[from] = true;
                    queue[found] = it.from;
                    found += 1;
                }
                firing = self.earlier[firing as usize];
            }
            next += 1;
        }
        leads
    }

    /// Cuts the classes that do not surely lead there and have a move of which some outcome does;
    /// whether there was anything to cut.
    pub(super) const fn refine(&self, surely: &[bool; MARKINGS], cuts: &mut Cuts) -> bool {
        let mut any = false;
        let (mut firing, mut last) = (0, NONE);
        while firing < self.fired {
            let it = &self.firings[firing];
            if it.from != last && !surely[it.from as usize] && surely[it.to as usize] {
                last = it.from;
                any = self.zone(it.from as usize).cut(cuts) || any;
            }
            firing += 1;
        }
        any
    }
}
