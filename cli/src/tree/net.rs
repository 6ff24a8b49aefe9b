//! The behaviour of a tree as a net: a place for each state and question, a transition for each
//! reply.

use crate::args::Format;
use crate::exit::Failure;
use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_trees::explore::{Assumptions, Limits, Point, Space};
use cotama_trees::tree::Tree;

/// Most points of a net; JANI has a variable for each.
const MOST: usize = 20_000;
const MOST_OF_JANI: usize = 2_000;

/// Makes the net: one token, a place `ended` beside that of each end, and as laws what holds.
pub(super) fn of(tree: &Tree, format: Format) -> Result<OwnedNet, Failure> {
    let most = if format == Format::Jani { MOST_OF_JANI } else { MOST };
    let limits = Limits { nodes: most, ..Limits::default() };
    let mut space = Space::explore(tree, false, Assumptions::default(), limits);
    if !space.is_complete() {
        let message = format!("more than {most} states and questions, each of which is a place");
        return Err(Failure::new(message).help("`cotama check` goes much further"));
    }
    let stuck = space.facts(&[]).stuck;
    net(&tree.name, &space.points(), stuck).ok_or_else(|| Failure::new("the net is too large"))
}

/// Returns nothing where there are more places or transitions than numbers.
fn net(name: &str, points: &[Point], stuck: usize) -> Option<OwnedNet> {
    let doc = "The states and questions of a behaviour tree, one of which holds the token.";
    let mut net = OwnedNet::new(name, doc);
    let mut places = Vec::new();
    for (at, point) in points.iter().enumerate() {
        let place = OwnedPlace::new(&point.name, u32::from(at == 0)).at_most(1);
        places.push(net.place(place).ok()?);
    }
    let ended = net.place(OwnedPlace::new("ended", 0).at_most(1)).ok()?;
    let mut number = 0;
    for (at, point) in points.iter().enumerate() {
        for (events, to) in &point.edges {
            number += 1;
            let mut transition = OwnedTransition::new(&format!("t{number}"))
                .doc(events)
                .take(places[at], 1)
                .give(places[*to], 1);
            if points[*to].is_end {
                transition = transition.give(ended, 1);
            }
            net.transition(transition).ok()?;
        }
    }
    let ends = points.iter().zip(&places).filter(|it| it.0.is_end);
    net.laws = ends.map(|it| OwnedLaw::Reachable(*it.1)).collect();
    if stuck == 0 {
        net.laws.push(OwnedLaw::AlwaysCan(ended));
    }
    Some(net)
}
