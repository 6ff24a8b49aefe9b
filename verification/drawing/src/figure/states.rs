//! A net that is a state machine as states and labelled edges.

use super::condition::{Case, Changes, Mirrors, assigned, change, change_words, join, set_words};
use super::{Edge, Entry, Figure, Flow, Kind, Label, Node};
use cotama_core::net::{Arc, Net, Role, Transition};
use std::collections::{BTreeMap, BTreeSet};

/// From so many states on, a line that leads to one state is drawn once.
const BUNDLED: usize = 3;

/// Returns the figure; `None` when the net is no state machine.
pub(super) fn figure<'n>(net: &Net<'n>) -> Option<Figure<'n>> {
    let moves = moves(net)?;
    let mut nodes = Vec::new();
    let mut node_of = BTreeMap::new();
    for (place, it) in net.places.iter().enumerate().filter(|(_, it)| it.role == Role::State) {
        node_of.insert(place, nodes.len());
        nodes.push(Node::of(Kind::State(place), it));
    }
    let mut bundles: Vec<(u32, usize, Label<'n>, Vec<usize>)> = Vec::new();
    for (line, from, to, label) in arrows(net, &moves) {
        let (from, to) = (node_of[&from], node_of[&to]);
        let same = |it: &&mut (u32, usize, Label<'_>, Vec<usize>)| {
            it.0 == line && it.1 == to && it.2.says_the_same(&label) && !it.3.contains(&from)
        };
        match bundles.iter_mut().find(same) {
            Some(bundle) => {
                bundle.3.push(from);
                // Which transitions belong to which source matters only once they are drawn apart
                // again.
                bundle.2.transitions.extend(label.transitions);
            }
            None => bundles.push((line, to, label, vec![from])),
        }
    }
    let mut edges: Vec<Edge<'n>> = Vec::new();
    for (_, to, label, sources) in bundles {
        if sources.len() >= BUNDLED {
            let sources = sources_words(&nodes, &sources, to);
            nodes[to].entries.push(Entry { sources, label });
            continue;
        }
        for &from in &sources {
            let mut own = label.clone();
            own.transitions.retain(|&at| node_of.get(&moves[at as usize].0) == Some(&from));
            let at =
                edges.iter().position(|it| (it.from, it.to) == (from, to)).unwrap_or_else(|| {
                    edges.push(Edge { from, to, flow: Flow::Move, weight: 1, labels: Vec::new() });
                    edges.len() - 1
                });
            match edges[at].labels.iter_mut().find(|it| it.says_the_same(&own)) {
                Some(label) => label.transitions.append(&mut own.transitions),
                None => edges[at].labels.push(own),
            }
        }
    }
    Some(Figure { name: net.name, doc: net.doc, is_states: true, nodes, edges })
}

/// By transition: from which state place to which. `None` when the net is no state machine.
fn moves(net: &Net<'_>) -> Option<Vec<(usize, usize)>> {
    let role = |place: usize| net.places.get(place).map(|it| it.role);
    let states = net.places.iter().filter(|it| it.role == Role::State);
    let one_token = states.map(|it| u64::from(it.initial)).sum::<u64>() == 1;
    let others =
        |role| matches!(role, Role::State | Role::Data | Role::Complement(_) | Role::Shared);
    if !one_token || !net.places.iter().all(|it| others(it.role)) {
        return None;
    }
    let state = |arcs: &[Arc]| {
        let mut states = arcs.iter().filter(|arc| role(arc.place.0 as usize) == Some(Role::State));
        match (states.next(), states.next()) {
            (None, _) => Some(None),
            (Some(arc), None) if arc.weight == 1 => Some(Some(arc.place.0 as usize)),
            _ => None,
        }
    };
    let ends = |it: &Transition<'_>| {
        let known = |arc: &Arc| (arc.place.0 as usize) < net.places.len();
        if !it.take.iter().chain(it.read).chain(it.give).all(known) {
            return None;
        }
        // A state that is only read stays: an edge to itself.
        match (state(it.take)?, state(it.read)?, state(it.give)?) {
            (Some(from), None, Some(to)) => Some((from, to)),
            (None, Some(stays), None) => Some((stays, stays)),
            _ => None,
        }
    };
    net.transitions.iter().map(ends).collect()
}

/// Returns the arrows to be drawn: line, from, to, label.
fn arrows<'n>(net: &Net<'n>, moves: &[(usize, usize)]) -> Vec<(u32, usize, usize, Label<'n>)> {
    let mirrors = Mirrors::of(net);
    let is_state = |arc: &&Arc| net.places[arc.place.0 as usize].role == Role::State;
    let mut groups: Vec<(u32, usize, usize, Label<'n>, Vec<Case>)> = Vec::new();
    let mut group_of: BTreeMap<(u32, usize, usize), Vec<usize>> = BTreeMap::new();
    for ((at, it), &(from, to)) in net.transitions.iter().enumerate().zip(moves) {
        let asked = it.take.iter().chain(it.read).filter(|arc| !is_state(arc));
        let touched: BTreeSet<usize> =
            it.take.iter().chain(it.give).map(|arc| arc.place.0 as usize).collect();
        let data = touched
            .into_iter()
            .filter(|&at| net.places[at].role != Role::State && !mirrors.hides(at));
        let changes: Changes =
            data.map(|at| (at, change(it, at))).filter(|&(_, change)| change != 0).collect();
        let case = Case {
            transitions: vec![at as u32],
            ranges: mirrors.ranges(net, asked),
            changes,
            set: Changes::new(),
        };
        let label = Label::of(net, it);
        let candidates = group_of.entry((it.line, from, to)).or_default();
        if let Some(&group) = candidates.iter().find(|&&group| groups[group].3 == label) {
            groups[group].4.push(case);
        } else {
            candidates.push(groups.len());
            groups.push((it.line, from, to, label, vec![case]));
        }
    }
    let mut arrows = Vec::new();
    for (line, from, to, label, cases) in groups {
        for Case { transitions, ranges, changes, set: assignments } in assigned(net, join(cases)) {
            let mut label = Label { transitions, ..label.clone() };
            label.guard = ranges.iter().map(|(&at, range)| range.words(&net.places[at])).collect();
            label
                .actions
                .extend(changes.iter().map(|(&at, &change)| change_words(&net.places[at], change)));
            let set = |(&at, &to): (&usize, &i64)| set_words(&net.places[at], to);
            label.actions.extend(assignments.iter().map(set));
            arrows.push((line, from, to, label));
        }
    }
    arrows
}

/// `any state`, `any other state`, `any other state but A`, or the names.
fn sources_words(nodes: &[Node<'_>], sources: &[usize], to: usize) -> String {
    let names = |of: &[usize]| of.iter().map(|&at| nodes[at].name).collect::<Vec<_>>().join(", ");
    let exceptions: Vec<usize> =
        (0..nodes.len()).filter(|&at| at != to && !sources.contains(&at)).collect();
    let any = if sources.contains(&to) { "any state" } else { "any other state" };
    match exceptions.len() {
        0 => any.to_owned(),
        few if 2 * few < sources.len() => format!("{any} but {}", names(&exceptions)),
        _ => names(sources),
    }
}
