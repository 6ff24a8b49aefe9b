//! Sets of transitions that what is outside does not disturb.

use crate::explicit::Look;
use crate::property::Marking;
use crate::pt::Pt;
use cotama_core::net::PlaceId;

/// What must be in a stubborn set because something else is: a graph whose nodes are transitions,
/// and for each place those that need it, those that take from it, and those that add to it.
pub(crate) struct Closure<'n> {
    pt: &'n Pt,
    takers: Vec<Vec<u32>>,
    givers: Vec<Vec<u32>>,
    /// For each node when it was met; 0 if it was not.
    met: Vec<u32>,
    /// For each node that was met the first one under way that it leads to; [`DONE`] when its
    /// component is complete.
    low: Vec<u32>,
    /// Nodes that were met, in their order.
    order: Vec<u32>,
    links: Vec<u32>,
}

/// Its component is complete, and leads to no transition that is enabled.
const DONE: u32 = u32::MAX - 1;
/// Its component is complete, and leads to a transition that is enabled.
const LIVE: u32 = u32::MAX;

/// A node that is being visited.
struct Visit {
    node: u32,
    /// Where its links begin, and the next one.
    start: usize,
    next: usize,
    /// Whether it leads to a complete component with a transition that is enabled.
    live: bool,
}

impl<'n> Closure<'n> {
    pub(crate) fn new(pt: &'n Pt) -> Self {
        let changers = |place: usize, sign: i64| {
            let all = pt.changers.of(place as u32).iter();
            all.filter(|it| it.1.signum() == sign).map(|it| it.0).collect()
        };
        let nodes = pt.transitions.len() + 3 * pt.places.len();
        Self {
            pt,
            takers: (0..pt.places.len()).map(|it| changers(it, -1)).collect(),
            givers: (0..pt.places.len()).map(|it| changers(it, 1)).collect(),
            met: vec![0; nodes],
            low: vec![0; nodes],
            order: Vec::new(),
            links: Vec::new(),
        }
    }

    /// The transitions that take from a place.
    pub(crate) fn takers(&self, place: u32) -> &[u32] {
        &self.takers[place as usize]
    }

    /// The transitions that add to a place.
    pub(crate) fn givers(&self, place: u32) -> &[u32] {
        &self.givers[place as usize]
    }

    /// Of the places that a disabled transition misses tokens in, the one that fewest transitions
    /// add to.
    pub(crate) fn missed(&self, look: Look<'_>, transition: u32) -> Option<u32> {
        let needs = self.pt.needs.of(transition).iter();
        let missed = needs.filter(|it| look.tokens(PlaceId(it.0)) < it.1.into()).map(|it| it.0);
        missed.min_by_key(|it| self.givers[*it as usize].len())
    }

    fn needers_of(&self, place: u32) -> u32 {
        self.pt.transitions.len() as u32 + place
    }

    fn takers_of(&self, place: u32) -> u32 {
        (self.pt.transitions.len() + self.pt.places.len()) as u32 + place
    }

    fn givers_of(&self, place: u32) -> u32 {
        (self.pt.transitions.len() + 2 * self.pt.places.len()) as u32 + place
    }

    /// Adds the nodes that must be in when a node is. What is outside never disturbs what is inside
    /// in that it still can be fired after it; that nothing outside disables what is inside is
    /// asked for as well where `lasting`.
    fn link(&mut self, look: Look<'_>, node: u32, lasting: bool) {
        let (pt, places) = (self.pt, self.pt.places.len() as u32);
        let Some(place) = node.checked_sub(pt.transitions.len() as u32) else {
            if look.enables(node) {
                for &(place, _) in pt.effects.of(node).iter().filter(|it| it.1 < 0) {
                    self.links.push(self.needers_of(place));
                }
                if lasting {
                    let takers = self.takers_of(0);
                    self.links.extend(pt.needs.of(node).iter().map(|it| takers + it.0));
                }
            } else {
                let needs = pt.needs.of(node).iter();
                let missed =
                    needs.filter(|it| look.tokens(PlaceId(it.0)) < it.1.into()).map(|it| it.0);
                // A place whose givers are in already costs nothing.
                let cost = |it: &u32| match self.met[self.givers_of(*it) as usize] {
                    0 => self.givers[*it as usize].len(),
                    _ => 0,
                };
                let link = missed.min_by_key(cost).map(|it| self.givers_of(it));
                self.links.extend(link);
            }
            return;
        };
        match place / places {
            0 => self.links.extend(pt.consumers.of(place).iter().map(|it| it.0)),
            1 => self.links.extend_from_slice(&self.takers[(place - places) as usize]),
            _ => self.links.extend_from_slice(&self.givers[(place - 2 * places) as usize]),
        }
    }

    fn forget(&mut self) {
        for node in self.order.drain(..) {
            self.met[node as usize] = 0;
        }
        self.links.clear();
    }

    /// The enabled transitions, in their order, of the least set with these transitions in which
    /// each that is disabled stays disabled while nothing of the set is fired, and each that is
    /// enabled disables nothing outside.
    pub(crate) fn around(&mut self, look: Look<'_>, first: &[u32]) -> Vec<u32> {
        self.forget();
        for &transition in first {
            self.meet(transition);
        }
        let mut at = 0;
        while let Some(&node) = self.order.get(at) {
            let start = self.links.len();
            self.link(look, node, false);
            while self.links.len() > start {
                let link = self.links.pop().unwrap_or(node);
                self.meet(link);
            }
            at += 1;
        }
        let transitions = self.pt.transitions.len() as u32;
        let mut enabled: Vec<u32> = self
            .order
            .iter()
            .copied()
            .filter(|it| *it < transitions && look.enables(*it))
            .collect();
        enabled.sort_unstable();
        enabled
    }

    fn meet(&mut self, node: u32) {
        if self.met[node as usize] == 0 {
            self.order.push(node);
            self.met[node as usize] = self.order.len() as u32;
        }
    }

    /// The enabled transitions, in their order, of a persistent set in which all that are enabled
    /// are `fine`: few, but at least one. `None` when none was found; the set of all transitions is
    /// always one.
    ///
    /// Strongly connected components of the graph that lead to no other one with an enabled
    /// transition.
    pub(crate) fn persistent(
        &mut self,
        look: Look<'_>,
        fine: impl Fn(u32) -> bool,
    ) -> Option<Vec<u32>> {
        self.forget();
        let mut best: Option<Vec<u32>> = None;
        let (mut visits, mut waiting): (Vec<Visit>, Vec<u32>) = (Vec::new(), Vec::new());
        for root in look.transitions() {
            if self.met[root as usize] != 0 {
                continue;
            }
            self.visit(look, root, &mut visits, &mut waiting);
            while let Some(visit) = visits.last_mut() {
                let node = visit.node as usize;
                if visit.next < self.links.len() {
                    let to = self.links[visit.next] as usize;
                    visit.next += 1;
                    match (self.met[to], self.low[to]) {
                        (0, _) => self.visit(look, to as u32, &mut visits, &mut waiting),
                        (_, DONE) => {}
                        (_, LIVE) => visit.live = true,
                        (_, low) => self.low[node] = self.low[node].min(low),
                    }
                    continue;
                }
                self.links.truncate(visit.start);
                let (mut live, low) = (visit.live, self.low[node]);
                visits.pop();
                if low == self.met[node] {
                    let from = waiting.iter().rposition(|it| *it as usize == node).unwrap_or(0);
                    let enabled = self.enabled(look, &waiting[from..]);
                    if !live && !enabled.is_empty() && enabled.iter().all(|it| fine(*it)) {
                        let single = enabled.len() == 1;
                        if best.as_ref().is_none_or(|best| enabled.len() < best.len()) {
                            best = Some(enabled.clone());
                        }
                        if single {
                            return best;
                        }
                    }
                    live |= !enabled.is_empty();
                    for member in waiting.drain(from..) {
                        self.low[member as usize] = if live { LIVE } else { DONE };
                    }
                }
                if let Some(before) = visits.last_mut() {
                    before.live |= live;
                    if low != self.met[node] {
                        let low_before = &mut self.low[before.node as usize];
                        *low_before = low.min(*low_before);
                    }
                }
            }
        }
        best
    }

    fn visit(
        &mut self,
        look: Look<'_>,
        node: u32,
        visits: &mut Vec<Visit>,
        waiting: &mut Vec<u32>,
    ) {
        self.meet(node);
        self.low[node as usize] = self.met[node as usize];
        let start = self.links.len();
        self.link(look, node, true);
        visits.push(Visit { node, start, next: start, live: false });
        waiting.push(node);
    }

    fn enabled(&self, look: Look<'_>, nodes: &[u32]) -> Vec<u32> {
        let transitions = self.pt.transitions.len() as u32;
        let mut enabled: Vec<u32> =
            nodes.iter().copied().filter(|it| *it < transitions && look.enables(*it)).collect();
        enabled.sort_unstable();
        enabled
    }
}
