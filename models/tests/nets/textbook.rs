//! The token game as textbooks have it: a marking is a list of numbers, nothing is packed, nothing
//! is clever.

use cotama_core::net::{Arc, EventId, Net, Role, Transition};
use std::collections::HashMap;

/// Tokens of each place.
pub(crate) type Marking = Vec<u32>;

/// All reachable markings, the initial one first, and the firings from each: transition and target.
#[derive(Debug, Default)]
pub(crate) struct Graph {
    pub(crate) markings: Vec<Marking>,
    pub(crate) firings: Vec<Vec<(usize, usize)>>,
}

/// Why a net has no finite graph to look at.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Trouble {
    /// A place got more tokens than it is declared for.
    Bound,
    /// More markings than were allowed.
    TooMany,
}

pub(crate) fn has(marking: &Marking, arcs: &[Arc]) -> bool {
    arcs.iter().all(|arc| marking[arc.place.0 as usize] >= arc.weight)
}

pub(crate) fn enabled(transition: &Transition<'_>, marking: &Marking) -> bool {
    has(marking, transition.take) && has(marking, transition.read)
}

/// Returns the marking left when a transition has taken its tokens.
pub(crate) fn taken(transition: &Transition<'_>, marking: &Marking) -> Marking {
    let mut left = marking.clone();
    transition.take.iter().for_each(|arc| left[arc.place.0 as usize] -= arc.weight);
    left
}

pub(crate) fn fired(transition: &Transition<'_>, marking: &Marking) -> Marking {
    let mut after = taken(transition, marking);
    transition.give.iter().for_each(|arc| after[arc.place.0 as usize] += arc.weight);
    after
}

/// Fires at once and by itself.
pub(crate) fn immediate(transition: &Transition<'_>) -> bool {
    transition.on.is_none() && transition.within.is_none()
}

pub(crate) fn settled(net: &Net<'_>, marking: &Marking) -> bool {
    !net.transitions.iter().any(|it| immediate(it) && enabled(it, marking))
}

/// The one that goes first among some transitions: the highest priority, then the first in the net.
pub(crate) fn first<'n>(
    net: &Net<'n>,
    among: impl Fn(&Transition<'n>) -> bool,
) -> Option<(usize, &'n Transition<'n>)> {
    let all = net.transitions.iter().enumerate().filter(|(_, it)| among(it));
    all.min_by_key(|(at, it)| (core::cmp::Reverse(it.priority), *at))
}

/// In any order.
pub(crate) fn explore(net: &Net<'_>, most: usize) -> Result<Graph, Trouble> {
    explore_by(net, most, |marking| {
        (0..net.transitions.len()).filter(|&at| enabled(&net.transitions[at], marking)).collect()
    })
}

/// As it is played: what fires at once by itself goes first, and of several the first one. Every
/// interval is taken to be open some time.
pub(crate) fn explore_played(net: &Net<'_>, most: usize) -> Result<Graph, Trouble> {
    explore_by(net, most, |marking| {
        if let Some((at, _)) = first(net, |it| immediate(it) && enabled(it, marking)) {
            return vec![at];
        }
        let on = |event| first(net, move |it| it.on == Some(event) && enabled(it, marking));
        let events = (0..net.events.len() as u32).filter_map(|it| Some(on(EventId(it))?.0));
        let timed = net.transitions.iter().enumerate();
        let timed = timed.filter(|(_, it)| it.on.is_none() && enabled(it, marking));
        let mut fires: Vec<usize> = events.chain(timed.map(|(at, _)| at)).collect();
        fires.sort_unstable();
        fires
    })
}

fn explore_by(
    net: &Net<'_>,
    most: usize,
    fires: impl Fn(&Marking) -> Vec<usize>,
) -> Result<Graph, Trouble> {
    let start: Marking = net.places.iter().map(|place| place.initial).collect();
    let mut numbers = HashMap::from([(start.clone(), 0)]);
    let mut graph = Graph { markings: vec![start], firings: vec![] };
    while let Some(marking) = graph.markings.get(graph.firings.len()).cloned() {
        let mut firings = vec![];
        for at in fires(&marking) {
            let after = fired(&net.transitions[at], &marking);
            if after.iter().zip(net.places).any(|(&tokens, place)| tokens > place.bound) {
                return Err(Trouble::Bound);
            }
            let to = *numbers.entry(after).or_insert_with_key(|after| {
                graph.markings.push(after.clone());
                graph.markings.len() - 1
            });
            firings.push((at, to));
        }
        graph.firings.push(firings);
        if graph.markings.len() > most {
            return Err(Trouble::TooMany);
        }
    }
    Ok(graph)
}

impl Graph {
    pub(crate) fn edges(&self) -> usize {
        self.firings.iter().map(Vec::len).sum()
    }

    /// The markings from which some firing sequence leads to a good one.
    pub(crate) fn leading_to(&self, good: impl Fn(&Marking) -> bool) -> Vec<bool> {
        let mut back = vec![vec![]; self.markings.len()];
        for (from, firings) in self.firings.iter().enumerate() {
            for &(_, to) in firings {
                back[to].push(from);
            }
        }
        let mut leads: Vec<bool> = self.markings.iter().map(good).collect();
        let mut open: Vec<usize> = (0..leads.len()).filter(|&it| leads[it]).collect();
        while let Some(to) = open.pop() {
            for &from in &back[to] {
                if !std::mem::replace(&mut leads[from], true) {
                    open.push(from);
                }
            }
        }
        leads
    }

    /// The most transitions that fire at once one after another; `None` when they can for ever.
    pub(crate) fn longest_settling(&self, net: &Net<'_>) -> Option<usize> {
        let mut depth = vec![0; self.markings.len()];
        for _ in 0..=self.markings.len() {
            let mut changed = false;
            for (from, firings) in self.firings.iter().enumerate() {
                for &(_, to) in firings.iter().filter(|(by, _)| immediate(&net.transitions[*by])) {
                    if depth[from] <= depth[to] {
                        (depth[from], changed) = (depth[to] + 1, true);
                    }
                }
            }
            if !changed {
                return depth.into_iter().max();
            }
        }
        None
    }
}

/// A marking in words, as "Extra, misses 2".
pub(crate) fn words(net: &Net<'_>, marking: &Marking) -> String {
    let mut words = vec![];
    for (place, &tokens) in net.places.iter().zip(marking) {
        match place.role {
            _ if tokens == 0 => {}
            Role::Complement(_) => {}
            Role::Data if place.bound > 1 => words.push(format!("{} {tokens}", place.name)),
            _ if tokens == 1 => words.push(place.name.to_owned()),
            _ => words.push(format!("{tokens} {}", place.name)),
        }
    }
    words.join(", ")
}
