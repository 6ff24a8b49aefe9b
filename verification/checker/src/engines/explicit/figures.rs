//! The figures of a state space.

use super::Limit;
use super::growth::Growth;
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;

/// The figures of the reachable markings; with a [`StateSpace::limit`], of those that were reached.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateSpace {
    /// Markings.
    pub states: u64,
    /// Pairs of a marking and a transition that is enabled in it.
    pub arcs: u64,
    /// The most tokens of a place.
    pub max_place: u64,
    /// The most tokens of all places together.
    pub max_sum: u64,
    /// For each place the most tokens it held.
    pub bounds: Vec<u64>,
    /// Markings that enable no transition.
    pub dead_markings: u64,
    /// Transitions that are enabled in no marking.
    pub dead_transitions: Vec<TransitionId>,
    /// The most firings that a marking is away from the initial one.
    pub depth: u64,
    /// Why there can be more; `None`: these are all.
    pub limit: Option<Limit>,
    /// Whether there is a most number of tokens for every place; `None`: unknown.
    pub bounded: Option<bool>,
    /// How tokens grow without end, if that was found.
    pub growth: Option<Growth>,
    /// Bytes at the end: tables and lists of markings.
    pub bytes: u64,
    /// The most bytes at any time.
    pub peak: u64,
}

impl StateSpace {
    /// Whether no place ever holds more than one token; `None`: unknown.
    pub fn safe(&self) -> Option<bool> {
        (self.max_place > 1 || self.limit.is_none()).then_some(self.max_place <= 1)
    }

    pub(super) fn none(pt: &Pt, limit: Limit) -> Self {
        Self {
            states: 0,
            arcs: 0,
            max_place: 0,
            max_sum: 0,
            bounds: vec![0; pt.places.len()],
            dead_markings: 0,
            dead_transitions: Vec::new(),
            depth: 0,
            limit: Some(limit),
            bounded: None,
            growth: None,
            bytes: 0,
            peak: 0,
        }
    }

    /// Bytes for each marking.
    #[allow(clippy::cast_precision_loss)] // a mean needs no more than a double's digits
    pub fn bytes_per_state(&self) -> f64 {
        self.bytes as f64 / self.states.max(1) as f64
    }
}

/// Markings of an unbounded net that are passed through.
pub(super) const OF_AN_UNBOUNDED_NET: u64 = 1 << 16;
