//! A net as places, transitions and arcs.

use super::condition::Mirrors;
use super::{Edge, Figure, Flow, Kind, Label, Node};
use cotama_core::net::{Arc, Net, Role, Transition};

pub(super) fn figure<'n>(net: &Net<'n>) -> Figure<'n> {
    let mirrors = Mirrors::of(net);
    let mut nodes = Vec::new();
    let mut node_of = vec![None; net.places.len()];
    for (place, it) in net.places.iter().enumerate().filter(|&(place, _)| !mirrors.hides(place)) {
        node_of[place] = Some(nodes.len());
        let kind = Kind::Place { place, shared: it.role == Role::Shared };
        nodes.push(Node::of(kind, it));
    }
    let mut edges = Vec::new();
    for (at, it) in net.transitions.iter().enumerate() {
        let here = nodes.len();
        let label = Some(Label {
            transitions: vec![at as u32],
            guard: guard(net, &mirrors, it),
            ..Label::of(net, it)
        });
        nodes.push(Node {
            kind: Kind::Transition(at),
            name: it.name,
            doc: it.doc,
            label,
            entries: Vec::new(),
            also: Vec::new(),
        });
        let node = |arc: &Arc| node_of.get(arc.place.0 as usize).copied().flatten();
        let edge = |from, to, flow, weight| Edge { from, to, flow, weight, labels: Vec::new() };
        for arc in it.take {
            let flow = if it.give.contains(arc) { Flow::Borrow } else { Flow::Move };
            edges.extend(node(arc).map(|place| edge(place, here, flow, arc.weight)));
        }
        let read =
            it.read.iter().filter_map(|arc| Some(edge(node(arc)?, here, Flow::Read, arc.weight)));
        edges.extend(read);
        let given = it.give.iter().filter(|arc| !it.take.contains(arc));
        edges.extend(given.filter_map(|arc| Some(edge(here, node(arc)?, Flow::Move, arc.weight))));
    }
    Figure { name: net.name, doc: net.doc, is_states: false, nodes, edges }
}

/// Returns the conditions on data, and all conditions on places that are not drawn.
fn guard(net: &Net<'_>, mirrors: &Mirrors, it: &Transition<'_>) -> Vec<String> {
    let is_data = |arc: &&Arc| {
        net.places
            .get(arc.place.0 as usize)
            .is_some_and(|place| matches!(place.role, Role::Data | Role::Shared))
    };
    let hidden = |arc: &&Arc| mirrors.hides(arc.place.0 as usize);
    let read = it.read.iter().filter(|arc| is_data(arc) || hidden(arc));
    let ranges = mirrors.ranges(net, read.chain(it.take.iter().filter(hidden)));
    ranges.into_iter().map(|(place, range)| range.words(&net.places[place])).collect()
}
