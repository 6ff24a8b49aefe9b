//! Places and transitions by the names that a property calls them.

use super::error::Fault;
use super::lexer::written;
use crate::pt::Pt;
use crate::source::quoted;
use cotama_core::net::{PlaceId, TransitionId};
use std::collections::HashMap;
use std::ops::Range;

/// The ids that the nodes of a net had in its file. Property files call nodes by id; where there is
/// none, by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ids<'a> {
    /// Names of places.
    pub places: &'a [String],
    /// Names of transitions.
    pub transitions: &'a [String],
}

/// The meaning of a word that is the id of one node and the name of another.
#[derive(Clone, Copy, Debug)]
pub(super) enum First {
    Ids,
    Names,
}

pub(super) struct Names<'a> {
    places: Index<'a>,
    transitions: Index<'a>,
}

/// The nodes of one kind.
struct Index<'a> {
    ids: &'a [String],
    names: &'a [String],
    positions: HashMap<&'a str, u32>,
}

impl<'a> Index<'a> {
    fn new(ids: &'a [String], names: &'a [String], first: First) -> Self {
        let mut positions = HashMap::with_capacity(names.len());
        let (first, second) = match first {
            First::Ids => (ids, names),
            First::Names => (names, ids),
        };
        let numbered = |it: &'a [String]| it.iter().zip(0..names.len() as u32);
        for (name, at) in numbered(first).chain(numbered(second)) {
            positions.entry(name.as_str()).or_insert(at);
        }
        Self { ids, names, positions }
    }

    /// Why there is no node of this name, and which was meant.
    fn missing(&self, noun: &str, name: &str, span: Range<usize>) -> Fault {
        const LISTED: usize = 5;
        let fault = Fault::new(span, format!("there is no {noun} {}", quoted(name)));
        let length = name.chars().count();
        let allowed = (length / 3).clamp(1, 8);
        let close = |candidate: &&'a String| {
            let near = length <= 64 && candidate.chars().count().abs_diff(length) <= allowed;
            let distance = near.then(|| strsim::osa_distance(name, candidate))?;
            // A word of one letter has nothing left when the letter is replaced.
            (distance <= allowed && distance < length).then_some((distance, *candidate))
        };
        let candidates = self.ids.iter().chain(self.names);
        match candidates.filter_map(|it| close(&it)).min_by_key(|&(distance, _)| distance) {
            Some((_, meant)) => fault.help(format!("did you mean {}?", shown(meant))),
            None if self.names.is_empty() => fault.help(format!("the net has no {noun}")),
            None => {
                let listed: Vec<_> = self.names.iter().take(LISTED).map(|it| shown(it)).collect();
                let more = if self.names.len() > LISTED { ", …" } else { "" };
                fault.help(format!("the net has {}{more}", listed.join(", ")))
            }
        }
    }
}

impl<'a> Names<'a> {
    pub(super) fn new(net: &'a Pt, ids: Ids<'a>, first: First) -> Self {
        Self {
            places: Index::new(ids.places, &net.places, first),
            transitions: Index::new(ids.transitions, &net.transitions, first),
        }
    }

    pub(super) fn is_place(&self, name: &str) -> bool {
        self.places.positions.contains_key(name)
    }

    /// Whether a place or a transition is called so.
    pub(super) fn is_known(&self, name: &str) -> bool {
        self.is_place(name) || self.transitions.positions.contains_key(name)
    }

    pub(super) fn place(&self, name: &str, span: Range<usize>) -> Result<PlaceId, Fault> {
        match self.places.positions.get(name) {
            Some(&at) => Ok(PlaceId(at)),
            None if self.transitions.positions.contains_key(name) => Err(Fault::new(
                span,
                format!("{} is a transition, and a place is expected", quoted(name)),
            )
            .help(format!("whether it is enabled says `fireable({})`", written(name)))),
            None => Err(self.places.missing("place", name, span)),
        }
    }

    pub(super) fn transition(&self, name: &str, span: Range<usize>) -> Result<TransitionId, Fault> {
        match self.transitions.positions.get(name) {
            Some(&at) => Ok(TransitionId(at)),
            None if self.is_place(name) => Err(Fault::new(
                span,
                format!("{} is a place, and a transition is expected", quoted(name)),
            )
            .help("give the name of a transition")),
            None => Err(self.transitions.missing("transition", name, span)),
        }
    }
}

/// A name as the language writes it, in backticks.
fn shown(name: &str) -> String {
    quoted(&written(name))
}
