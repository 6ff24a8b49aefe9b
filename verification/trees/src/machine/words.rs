//! Questions, replies, events: the words in which a machine and the world speak.

use crate::tree::{Answer, Tree};

/// Status that a node keeps between ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// IDLE.
    Idle,
    /// RUNNING.
    Running,
    /// SUCCESS, not reset.
    Success,
    /// FAILURE, not reset.
    Failure,
}

impl Status {
    pub(super) fn of_code(code: u32) -> Status {
        match code {
            0 => Status::Idle,
            1 => Status::Running,
            2 => Status::Success,
            _ => Status::Failure,
        }
    }

    /// Returns the letter: I, R, S, F.
    pub fn letter(self) -> char {
        match self {
            Status::Idle => 'I',
            Status::Running => 'R',
            Status::Success => 'S',
            Status::Failure => 'F',
        }
    }
}

/// Reply of the world to a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reply {
    /// A leaf's answer.
    Leaf(Answer),
    /// Open, or elapsed.
    Yes,
    /// Closed, or not elapsed.
    No,
}

impl Reply {
    /// Returns the letter of traces.
    pub fn letter(self) -> char {
        match self {
            Reply::Leaf(it) => it.letter(),
            Reply::Yes => 'T',
            Reply::No => 'N',
        }
    }

    /// Returns the reply of this letter.
    pub fn of_letter(letter: char) -> Option<Reply> {
        Some(match letter {
            'S' => Reply::Leaf(Answer::Success),
            'F' => Reply::Leaf(Answer::Failure),
            'R' => Reply::Leaf(Answer::Running),
            'K' => Reply::Leaf(Answer::Skipped),
            'T' => Reply::Yes,
            'N' => Reply::No,
            _ => return None,
        })
    }
}

/// Manner of asking a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum How {
    /// A leaf that does not run, `:`.
    Starts,
    /// A leaf that runs, `~`.
    Goes,
    /// A decorator or a timer looks at the world, `?`.
    Looks,
}

impl How {
    /// Returns the sign of traces.
    pub fn sign(self) -> char {
        match self {
            How::Starts => ':',
            How::Goes => '~',
            How::Looks => '?',
        }
    }
}

/// A question to the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Question {
    /// The node that asks.
    pub node: usize,
    /// Manner of asking.
    pub how: How,
    /// Replies that are allowed.
    pub replies: &'static [Reply],
}

/// Something that happened, as traces have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Event {
    /// A question and its reply.
    Asked(u32, How, Reply),
    /// A leaf answered by its own rule, `=`.
    Itself(u32, Answer),
    /// A running leaf was halted, `!`.
    Halted(u32),
}

impl Event {
    /// Returns the node.
    pub fn node(self) -> usize {
        match self {
            Event::Asked(node, ..) | Event::Itself(node, _) | Event::Halted(node) => node as usize,
        }
    }

    /// Writes the event with the node's label.
    pub fn shown(self, tree: &Tree) -> String {
        let label = &tree.nodes[self.node()].label;
        match self {
            Event::Asked(_, how, reply) => format!("{label}{}{}", how.sign(), reply.letter()),
            Event::Itself(_, answer) => format!("{label}={}", answer.letter()),
            Event::Halted(_) => format!("{label}!"),
        }
    }
}

/// An exception of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thrown {
    /// The node that the library names, if any.
    pub node: Option<usize>,
    /// The cause.
    pub why: String,
}

/// Point at which a tick stops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The world is asked.
    Asked(Question),
    /// The root has answered.
    Answered(Answer),
    /// An exception; the run is over.
    Thrown(Thrown),
}
