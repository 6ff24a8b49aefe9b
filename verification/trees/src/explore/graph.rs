//! Points and edges of the graph.

use crate::machine::Reply;
use crate::tree::{Answer, Tree};

/// How a run ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// The root answers: SUCCESS, FAILURE or SKIPPED.
    Answered(Answer),
    /// An exception, with the node that the library names.
    Thrown(Option<usize>),
}

impl End {
    /// Writes the end as traces have it.
    pub fn shown(self, tree: &Tree) -> String {
        match self {
            End::Answered(it) => it.letter().to_string(),
            End::Thrown(None) => "X".to_owned(),
            End::Thrown(Some(node)) => format!("X@{}", tree.nodes[node].label),
        }
    }
}

/// A point of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    State,
    /// The node that asks.
    Asks(usize),
    End(End),
}

/// An edge: the reply, what happened, where to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) target: u32,
    /// Number of its events, 8 bits to the left of the reply, and whether the tick ends with a
    /// wake-up.
    pub(super) rest: u32,
}

pub(super) const WAKES: u32 = 0x80;
/// Sequences of events that an edge can name.
pub(super) const MAX_SEQUENCES: u32 = 1 << 24;

pub(super) fn code(reply: Option<Reply>) -> u32 {
    match reply {
        None => 0,
        Some(Reply::Leaf(it)) => 1 + it as u32,
        Some(Reply::Yes) => 5,
        Some(Reply::No) => 6,
    }
}

impl Edge {
    pub(crate) fn reply(self) -> Option<Reply> {
        Some(match self.rest & 0x7f {
            1 => Reply::Leaf(Answer::Success),
            2 => Reply::Leaf(Answer::Failure),
            3 => Reply::Leaf(Answer::Running),
            4 => Reply::Leaf(Answer::Skipped),
            5 => Reply::Yes,
            6 => Reply::No,
            _ => return None,
        })
    }

    /// Returns the number of the events.
    pub(crate) fn events(self) -> u32 {
        self.rest >> 8
    }

    pub(crate) fn wakes(self) -> bool {
        self.rest & WAKES != 0
    }
}
