//! Sets of transitions that what is outside does not disturb.

use crate::components::{Digraph, Search};
use crate::explicit::Look;
use cotama_core::net::PlaceId;
use cotama_property::Marking;
use cotama_property::pt::Pt;
use std::ops::ControlFlow;

/// The closure of stubborn sets: a graph whose nodes are transitions, and for each place its
/// readers, its consumers and its producers; an edge leads to a node that must be in the set as
/// well.
pub(crate) struct Closure<'n> {
    pt: &'n Pt,
    consumers: Vec<Vec<u32>>,
    producers: Vec<Vec<u32>>,
    met: Vec<bool>,
    /// For each node that was met whether it is known to lead to a transition that is enabled, in a
    /// complete component.
    live: Vec<bool>,
    /// Nodes that were met, in their order.
    order: Vec<u32>,
    links: Vec<u32>,
    search: Search,
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
            consumers: (0..pt.places.len()).map(|it| changers(it, -1)).collect(),
            producers: (0..pt.places.len()).map(|it| changers(it, 1)).collect(),
            met: vec![false; nodes],
            live: vec![false; nodes],
            order: Vec::new(),
            links: Vec::new(),
            search: Search::new(nodes),
        }
    }

    /// The transitions that take from a place.
    pub(crate) fn consumers(&self, place: u32) -> &[u32] {
        &self.consumers[place as usize]
    }

    /// The transitions that add to a place.
    pub(crate) fn producers(&self, place: u32) -> &[u32] {
        &self.producers[place as usize]
    }

    /// Returns the place with the fewest producers among those in which a disabled transition
    /// misses tokens.
    pub(crate) fn missed(&self, look: Look<'_>, transition: u32) -> Option<u32> {
        let needs = self.pt.needs.of(transition).iter();
        let missed = needs.filter(|it| look.tokens(PlaceId(it.0)) < it.1.into()).map(|it| it.0);
        missed.min_by_key(|it| self.producers[*it as usize].len())
    }

    fn needers_of(&self, place: u32) -> u32 {
        self.pt.transitions.len() as u32 + place
    }

    fn consumers_of(&self, place: u32) -> u32 {
        (self.pt.transitions.len() + self.pt.places.len()) as u32 + place
    }

    fn producers_of(&self, place: u32) -> u32 {
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
                    let consumers = self.consumers_of(0);
                    self.links.extend(pt.needs.of(node).iter().map(|it| consumers + it.0));
                }
            } else {
                let needs = pt.needs.of(node).iter();
                let missed =
                    needs.filter(|it| look.tokens(PlaceId(it.0)) < it.1.into()).map(|it| it.0);
                // A place whose producers are in already costs nothing.
                let is_in = |it: u32| self.met[self.producers_of(it) as usize];
                let cost =
                    |it: &u32| if is_in(*it) { 0 } else { self.producers[*it as usize].len() };
                let link = missed.min_by_key(cost).map(|it| self.producers_of(it));
                self.links.extend(link);
            }
            return;
        };
        match place / places {
            0 => self.links.extend(pt.consumers.of(place).iter().map(|it| it.0)),
            1 => self.links.extend_from_slice(&self.consumers[(place - places) as usize]),
            _ => self.links.extend_from_slice(&self.producers[(place - 2 * places) as usize]),
        }
    }

    fn forget(&mut self) {
        for node in self.order.drain(..) {
            self.met[node as usize] = false;
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
        let is_in = |it: &u32| !look.enables(*it) || enabled.binary_search(it).is_ok();
        debug_assert!(first.iter().all(is_in), "what it is made around is in it");
        enabled
    }

    fn meet(&mut self, node: u32) {
        if !std::mem::replace(&mut self.met[node as usize], true) {
            self.order.push(node);
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
        let mut search = std::mem::take(&mut self.search);
        let mut sets = Sets { closure: self, look, fine, starts: Vec::new(), best: None };
        for root in look.transitions() {
            if search.pass(&mut sets, root).is_break() {
                break;
            }
        }
        let best = sets.best;
        debug_assert!(best.iter().all(|it| !it.is_empty() && it.is_sorted()));
        debug_assert!(best.iter().flatten().all(|it| look.enables(*it)), "a set of enabled ones");
        search.forget(&self.order);
        self.search = search;
        best
    }

    fn enabled(&self, look: Look<'_>, nodes: &[u32]) -> Vec<u32> {
        let transitions = self.pt.transitions.len() as u32;
        let mut enabled: Vec<u32> =
            nodes.iter().copied().filter(|it| *it < transitions && look.enables(*it)).collect();
        enabled.sort_unstable();
        enabled
    }
}

/// The search for the smallest persistent set.
struct Sets<'c, 'n, F> {
    closure: &'c mut Closure<'n>,
    look: Look<'c>,
    fine: F,
    /// For each node under way where its links begin.
    starts: Vec<usize>,
    best: Option<Vec<u32>>,
}

impl<F: Fn(u32) -> bool> Digraph for Sets<'_, '_, F> {
    fn meet(&mut self, node: u32) {
        self.closure.meet(node);
        self.closure.live[node as usize] = false;
        self.starts.push(self.closure.links.len());
        self.closure.link(self.look, node, true);
    }

    fn successor(&mut self, _node: u32, at: u32) -> Option<u32> {
        self.closure.links.get(self.starts.last()? + at as usize).copied()
    }

    fn leave(&mut self, node: u32) {
        let Closure { links, live, .. } = &mut *self.closure;
        let start = self.starts.pop().unwrap_or(links.len());
        live[node as usize] = links[start..].iter().any(|it| live[*it as usize]);
        links.truncate(start);
    }

    fn component(&mut self, members: &[u32]) -> ControlFlow<()> {
        let enabled = self.closure.enabled(self.look, members);
        let live = &mut self.closure.live;
        let leads = members.iter().any(|it| live[*it as usize]);
        let is_live = leads || !enabled.is_empty();
        members.iter().for_each(|it| live[*it as usize] = is_live);
        if leads || enabled.is_empty() || !enabled.iter().all(|it| (self.fine)(*it)) {
            return ControlFlow::Continue(());
        }
        let is_single = enabled.len() == 1;
        if self.best.as_ref().is_none_or(|best| enabled.len() < best.len()) {
            self.best = Some(enabled);
        }
        if is_single { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
