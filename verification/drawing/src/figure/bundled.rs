//! A large net so that a person can follow it: transitions that do the same to the same places
//! share a bar, and data are words.
//!
//! A line of the definition that a group of places turned into many transitions is drawn once: what
//! they all take, need or give is an arrow, where they differ the label says `from a or b`. Lines
//! that then have the same arrows share one bar, with a list of their labels. The names that the
//! program made from the groups are hidden behind those of the lines.

use super::condition::{Changes, Mirrors, change, change_words};
use super::{Edge, Figure, Flow, Kind, Label, Node};
use cotama_core::net::{Arc, Net, Role, Transition};
use std::collections::{BTreeMap, BTreeSet};

/// From so many transitions on a net is drawn like this.
pub(super) const LARGE: usize = 50;

/// An arrow: the place in the net, what it does, and how many tokens.
type Arrow = (usize, Way, u32);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Way {
    Take,
    Read,
    Give,
}

/// The transitions of a line that say the same.
struct Bundle<'n> {
    line: u32,
    name: &'n str,
    doc: &'n str,
    label: Label<'n>,
    arrows: Vec<BTreeSet<Arrow>>,
}

/// The figure; of a small net, or of one in which nothing can be bundled, `None`.
pub(super) fn figure<'n>(net: &Net<'n>) -> Option<Figure<'n>> {
    if net.transitions.len() < LARGE {
        return None;
    }
    let mirrors = Mirrors::of(net);
    let is_drawn = |place: usize| {
        net.places.get(place).is_some_and(|it| it.role == Role::State) && !mirrors.hides(place)
    };
    let mut bars: BTreeMap<BTreeSet<Arrow>, usize> = BTreeMap::new();
    let mut nodes = Vec::new();
    let mut node_of = BTreeMap::new();
    for (place, it) in net.places.iter().enumerate().filter(|it| is_drawn(it.0)) {
        node_of.insert(place, nodes.len());
        let kind = Kind::Place { place, shared: false };
        nodes.push(Node::of(kind, it));
    }
    let mut edges = Vec::new();
    for bundle in bundles(net, &mirrors, &is_drawn) {
        let (common, label) = bundle.parts(net);
        if let Some(&bar) = bars.get(&common) {
            let bar: &mut Node<'n> = &mut nodes[bar];
            bar.also.push((bundle.name, label));
            continue;
        }
        let here = nodes.len();
        let first = *label.transitions.first()? as usize;
        for &(at, way, weight) in &common {
            let place = node_of[&at];
            let has = |way| common.contains(&(at, way, weight));
            let (from, to, flow) = match way {
                Way::Take if has(Way::Give) => (place, here, Flow::Borrow),
                Way::Give if has(Way::Take) => continue,
                Way::Take => (place, here, Flow::Move),
                Way::Read => (place, here, Flow::Read),
                Way::Give => (here, place, Flow::Move),
            };
            edges.push(Edge { from, to, flow, weight, labels: Vec::new() });
        }
        bars.insert(common, here);
        nodes.push(Node {
            kind: Kind::Transition(first),
            name: bundle.name,
            doc: bundle.doc,
            label: Some(label),
            entries: Vec::new(),
            also: Vec::new(),
        });
    }
    let drawn = nodes.len() - node_of.len();
    (drawn < net.transitions.len()).then_some(Figure {
        name: net.name,
        doc: net.doc,
        is_states: false,
        nodes,
        edges,
    })
}

/// The name of a line: that of its transitions up to what a group or a counter added.
fn line_name<'n>(it: &Transition<'n>) -> &'n str {
    it.name.split('.').next().unwrap_or(it.name)
}

fn bundles<'n>(
    net: &Net<'n>,
    mirrors: &Mirrors,
    is_drawn: &dyn Fn(usize) -> bool,
) -> Vec<Bundle<'n>> {
    let mut bundles: Vec<Bundle<'n>> = Vec::new();
    for (at, it) in net.transitions.iter().enumerate() {
        let mut arrows = BTreeSet::new();
        let drawn = |arc: &&Arc| is_drawn(arc.place.0 as usize);
        for (arcs, way) in [(it.take, Way::Take), (it.read, Way::Read), (it.give, Way::Give)] {
            let of = |arc: &Arc| (arc.place.0 as usize, way, arc.weight);
            arrows.extend(arcs.iter().filter(drawn).map(of));
        }
        let mut label = Label { transitions: vec![at as u32], ..Label::of(net, it) };
        let is_known = |arc: &&Arc| (arc.place.0 as usize) < net.places.len();
        let asked = it.take.iter().chain(it.read).filter(is_known).filter(|arc| !drawn(arc));
        let ranges = mirrors.ranges(net, asked);
        label.guard =
            ranges.into_iter().map(|(place, range)| range.words(&net.places[place])).collect();
        let touched: BTreeSet<usize> =
            it.take.iter().chain(it.give).map(|arc| arc.place.0 as usize).collect();
        let changed: Changes = touched
            .into_iter()
            .filter(|&place| place < net.places.len() && !is_drawn(place))
            .filter(|&place| !mirrors.hides(place))
            .map(|place| (place, change(it, place)))
            .filter(|&(_, change)| change != 0)
            .collect();
        label
            .actions
            .extend(changed.iter().map(|(&place, &by)| change_words(&net.places[place], by)));
        let same = |bundle: &&mut Bundle<'_>| {
            (bundle.line, bundle.name) == (it.line, line_name(it))
                && bundle.label.says_the_same(&label)
        };
        match bundles.iter_mut().rev().find(same) {
            Some(bundle) => {
                bundle.label.transitions.push(at as u32);
                bundle.arrows.push(arrows);
            }
            None => bundles.push(Bundle {
                line: it.line,
                name: line_name(it),
                doc: it.doc,
                label,
                arrows: vec![arrows],
            }),
        }
    }
    bundles.into_iter().flat_map(|it| it.exact(net)).collect()
}

impl<'n> Bundle<'n> {
    /// The arrows that all transitions have.
    fn common(&self) -> BTreeSet<Arrow> {
        let mut common = self.arrows.first().cloned().unwrap_or_default();
        common.retain(|arrow| self.arrows.iter().all(|it| it.contains(arrow)));
        common
    }

    /// Itself, if its transitions differ in one arrow each of the same kind, which words can say
    /// exactly; otherwise each transition for itself.
    fn exact(self, net: &Net<'n>) -> Vec<Self> {
        let common = self.common();
        let own = |it: &BTreeSet<Arrow>| -> Vec<Way> {
            it.difference(&common).map(|arrow| arrow.1).collect()
        };
        let ways: Vec<Vec<Way>> = self.arrows.iter().map(own).collect();
        let single = self.arrows.iter().flat_map(|it| it.difference(&common)).all(|it| it.2 == 1);
        let alike = ways.windows(2).all(|it| it[0] == it[1]) && ways.iter().all(|it| it.len() < 2);
        if single && alike {
            return vec![self];
        }
        let alone = |(&at, arrows): (&u32, BTreeSet<Arrow>)| Self {
            name: net.transitions[at as usize].name,
            label: Label { transitions: vec![at], ..self.label.clone() },
            arrows: vec![arrows],
            ..self
        };
        self.label.transitions.iter().zip(self.arrows.clone()).map(alone).collect()
    }

    /// The arrows that all transitions have, and the label with those in which they differ.
    fn parts(&self, net: &Net<'_>) -> (BTreeSet<Arrow>, Label<'n>) {
        let common = self.common();
        let all: BTreeSet<Arrow> = self.arrows.iter().flatten().copied().collect();
        let mut label = self.label.clone();
        let words = [(Way::Take, "from"), (Way::Read, "while"), (Way::Give, "to")];
        for (way, word) in words {
            let names: Vec<&str> = all
                .difference(&common)
                .filter(|it| it.1 == way)
                .map(|it| net.places[it.0].name)
                .collect();
            if let [others @ .., last] = &names[..] {
                let others = others.join(", ");
                let or = if others.is_empty() { "" } else { " or " };
                label.places.push(format!("{word} {others}{or}{last}"));
            }
        }
        (common, label)
    }
}
