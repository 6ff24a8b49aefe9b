//! A time net as a net of libpetri.

use crate::measure::Counts;
use cotama_core::net::Arc;
use cotama_verification::tpn::{Interval, TimeNet};
use libpetri_core::action::fork;
use libpetri_core::input::exactly;
use libpetri_core::output::{and, out_place};
use libpetri_core::petri_net::PetriNet;
use libpetri_core::place::Place;
use libpetri_core::timing::{MAX_DURATION_MS, Timing, delayed, immediate, window};
use libpetri_core::transition::Transition;
use libpetri_core::{arc, input::In};
use libpetri_verification::dbm::Dbm;
use libpetri_verification::marking_state::{MarkingState, MarkingStateBuilder};
use libpetri_verification::state_class_graph::StateClassGraph;
use std::collections::HashSet;

/// A net as libpetri has them, and its initial marking.
pub struct Translated(PetriNet, MarkingState);

impl Translated {
    /// Translates a net; or says what libpetri cannot express of it.
    pub fn new(net: &TimeNet) -> Result<Self, String> {
        let places: Vec<Place<()>> = net.places().iter().map(|it| Place::new(&*it.name)).collect();
        let place = |arc: &Arc| &places[arc.place.0 as usize];
        let transitions = net.transitions().iter().map(|it| {
            if it.give.iter().any(|arc| arc.weight > 1) {
                return Err(format!("`{}` gives several tokens to a place", it.name));
            }
            if it.read.iter().any(|arc| arc.weight > 1) {
                return Err(format!("`{}` reads several tokens of a place", it.name));
            }
            let takes: Vec<In> =
                it.take.iter().map(|arc| exactly(arc.weight as usize, place(arc))).collect();
            let reads = it.read.iter().map(|arc| arc::read(place(arc))).collect();
            let timing =
                timing(it.interval).ok_or_else(|| format!("`{}` has an open interval", it.name))?;
            let built = Transition::builder(&*it.name).inputs(takes).reads(reads).timing(timing);
            let gives: Vec<_> = it.give.iter().map(|arc| out_place(place(arc))).collect();
            // The graph looks at arcs only; that there is an action is checked.
            Ok(if gives.is_empty() { built } else { built.output(and(gives)).action(fork()) }
                .build())
        });
        let transitions = transitions.collect::<Result<Vec<_>, String>>()?;
        let initial = net.places().iter().fold(MarkingStateBuilder::new(), |marking, it| {
            marking.tokens(&*it.name, it.initial as usize)
        });
        Ok(Self(PetriNet::builder(net.name()).transitions(transitions).build(), initial.build()))
    }

    /// Returns the graph of state classes; or says that there are more than so many.
    pub fn classes(&self, most: usize) -> Result<StateClassGraph, String> {
        let graph = StateClassGraph::build(&self.0, &self.1, most);
        if graph.is_complete() { Ok(graph) } else { Err(format!("no end after {most} classes")) }
    }
}

/// Returns the figures of a graph.
pub fn counts(graph: &StateClassGraph) -> Counts {
    Counts { nodes: graph.class_count() as u64, edges: graph.edge_count() as u64 }
}

/// The classes of a net as TINA and this project define them, by the matrices of libpetri, which
/// are given no time to pass: a second opinion of the same definition. It is slow, and not
/// measured.
pub fn linear(net: &TimeNet) -> Counts {
    let names = |ids: &[usize]| {
        ids.iter().map(|&it| net.transitions()[it].name.clone()).collect::<Vec<_>>()
    };
    let lower = |ids: &[usize]| {
        ids.iter().map(|&it| net.transitions()[it].interval.lower as f64).collect::<Vec<_>>()
    };
    let upper = |ids: &[usize]| {
        let end = |&it: &usize| {
            net.transitions()[it].interval.upper.map_or(f64::INFINITY, |it| it as f64)
        };
        ids.iter().map(end).collect::<Vec<_>>()
    };
    let initial: Vec<u32> = net.places().iter().map(|it| it.initial).collect();
    let first = enabled(net, &initial);
    let mut open =
        vec![(initial, Dbm::create(names(&first), &lower(&first), &upper(&first)), first)];
    let key = |marking: &[u32], domain: &Dbm| (marking.to_vec(), domain.zone_key());
    let mut known = HashSet::from([key(&open[0].0, &open[0].1)]);
    let mut edges = 0;
    while let Some((marking, domain, transitions)) = open.pop() {
        for (at, &fired) in transitions.iter().enumerate() {
            let mut after = marking.clone();
            net.transitions()[fired]
                .take
                .iter()
                .for_each(|arc| after[arc.place.0 as usize] -= arc.weight);
            let between = enabled(net, &after);
            net.transitions()[fired]
                .give
                .iter()
                .for_each(|arc| after[arc.place.0 as usize] += arc.weight);
            let next = enabled(net, &after);
            let stays = |it: &usize| *it != fired && between.contains(it) && next.contains(it);
            let kept: Vec<usize> =
                (0..transitions.len()).filter(|&at| stays(&transitions[at])).collect();
            let old: Vec<usize> = kept.iter().map(|&at| transitions[at]).collect();
            let new: Vec<usize> = next.into_iter().filter(|it| !old.contains(it)).collect();
            let domain =
                domain.fire_transition(at, &names(&new), &lower(&new), &upper(&new), &kept);
            if domain.is_empty() {
                continue;
            }
            edges += 1;
            let all = [old, new].concat();
            let mut order: Vec<usize> = (0..all.len()).collect();
            order.sort_by_key(|&at| all[at]);
            let domain = domain.permuted(&order);
            if known.insert(key(&after, &domain)) {
                open.push((after, domain, order.iter().map(|&at| all[at]).collect()));
            }
        }
    }
    Counts { nodes: known.len() as u64, edges }
}

/// The transitions that a marking enables.
fn enabled(net: &TimeNet, marking: &[u32]) -> Vec<usize> {
    let holds = |arc: &Arc| marking[arc.place.0 as usize] >= arc.weight;
    let all = net.transitions().iter().enumerate();
    all.filter(|(_, it)| it.take.iter().chain(&it.read).all(holds)).map(|(at, _)| at).collect()
}

/// One unit of time is one second, so that its floating-point numbers are whole and compared
/// exactly.
fn timing(interval: Interval) -> Option<Timing> {
    let milliseconds = |time: u64| time.checked_mul(1000).filter(|&it| it <= MAX_DURATION_MS);
    let is_open = interval.lower_strict || interval.upper.is_some() && interval.upper_strict;
    let lower = milliseconds(interval.lower).filter(|_| !is_open)?;
    Some(match interval.upper {
        Some(upper) => window(lower, milliseconds(upper)?),
        None if lower == 0 => immediate(),
        None => delayed(lower),
    })
}
