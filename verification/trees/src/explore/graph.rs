//! Points and edges of the graph.

use super::Space;
use crate::machine::{MOST_MOVES, Reply};
use crate::tree::{Answer, Tree};

/// How a run ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// The root answers: SUCCESS, FAILURE or SKIPPED.
    Answered(Answer),
    /// An exception, with the node that the library names.
    Thrown(Option<usize>),
    /// The supervisor halts the tree.
    Halted,
}

impl End {
    /// Writes the end as traces have it.
    pub fn shown(self, tree: &Tree) -> String {
        match self {
            End::Answered(it) => it.letter().to_string(),
            End::Halted => "H".to_owned(),
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

/// A point of the graph as others may read it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// `s0`, `s1` and so on for states between ticks, `q5_Spin` for questions, `end_S`, `end_X`.
    pub name: String,
    /// Whether a run ends there.
    pub is_end: bool,
    /// Replies with their events, and the points that they lead to.
    pub edges: Vec<(String, usize)>,
}

impl Space<'_> {
    /// Returns all points, the first of which is the fresh tree.
    pub fn points(&self) -> Vec<Point> {
        let point = |at: usize| {
            let what = self.what(at);
            let name = match what {
                What::State => format!("s{at}"),
                What::Asks(node) => format!("q{at}_{}", self.tree.shown(node)),
                What::End(end) => format!("end_{}", end.shown(self.tree)),
            };
            let edges = self.out(at).map(|it| {
                let events = self.events(it).iter().map(|it| it.shown(self.tree));
                let events = events.collect::<Vec<_>>().join(" ");
                (events, self.edges[it].target as usize)
            });
            Point { name, is_end: matches!(what, What::End(_)), edges: edges.collect() }
        };
        (0..self.len()).map(point).collect()
    }
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
/// Code of the first child that somebody may choose, above those of a supervisor's moves.
const FIRST_CHILD: u32 = 8 + MOST_MOVES as u32;
/// Sequences of events that an edge can name.
pub(super) const MAX_SEQUENCES: u32 = 1 << 24;

pub(super) fn code(reply: Option<Reply>) -> u32 {
    match reply {
        None => 0,
        Some(Reply::Leaf(it)) => 1 + it as u32,
        Some(Reply::Yes) => 5,
        Some(Reply::No) => 6,
        Some(Reply::Rest) => 7,
        Some(Reply::Net(it)) => 8 + it as u32,
        Some(Reply::Child(it)) => FIRST_CHILD + it as u32,
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
            7 => Reply::Rest,
            it @ FIRST_CHILD.. => Reply::Child((it - FIRST_CHILD) as u8),
            it @ 8.. => Reply::Net(it as u8 - 8),
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
