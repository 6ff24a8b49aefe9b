//! The paths from one place of a round to another.

use super::branch::{Branch, Held};
use cotama_core::net::{EventId, OutputId, PlaceId};
use std::collections::BTreeMap;

/// The part of a round that a transition of [`Rounds`](super::rounds::Rounds) plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The token goes on to the next mailbox, or an observer looks: nothing happens in the system.
    Between,
    /// A net settles or reads a mailbox.
    Turn,
    /// An event from outside, or none.
    Outside,
}

/// A path from one place of the round to another.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) part: Part,
    pub(super) name: String,
    pub(super) doc: String,
    pub(super) on: Option<EventId>,
    pub(super) emits: Vec<OutputId>,
    /// The results of all tests; once the whole net is made, without those that follow from others.
    pub(super) held: Held,
    pub(super) change: BTreeMap<PlaceId, i64>,
}

impl Path {
    pub(super) fn new(
        part: Part,
        name: String,
        from: PlaceId,
        to: PlaceId,
        branch: &Branch<'_>,
    ) -> Self {
        let mut path = Self {
            part,
            name,
            doc: String::new(),
            on: None,
            emits: Vec::new(),
            held: branch.held.clone(),
            change: branch.change.clone(),
        };
        path.held.insert(from, (1, 1));
        *path.change.entry(from).or_default() -= 1;
        *path.change.entry(to).or_default() += 1;
        path
    }
}
