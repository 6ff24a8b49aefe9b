//! Questions, replies, events: the words in which a machine and the world speak.

use crate::supervisor::Part;
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
    /// The supervisor has done what it does: the tree is ticked.
    Rest,
    /// The supervisor makes one of its moves.
    Net(u8),
    /// Somebody chooses the child at this place.
    Child(u8),
}

/// Most moves of a supervisor.
pub const MOST_MOVES: usize = 110;

/// Most children among which somebody can choose.
pub const MOST_CHOICES: usize = 9;

/// Replies of somebody who chooses among so many children, or answers at once.
pub(super) fn choices(count: usize) -> &'static [Reply] {
    const ALL: [Reply; MOST_CHOICES + 3] = {
        let ends = [Answer::Success, Answer::Failure, Answer::Running];
        let mut all = [Reply::Child(0); MOST_CHOICES + 3];
        let mut at = 0;
        while at < all.len() {
            all[at] = match at {
                0..3 => Reply::Leaf(ends[at]),
                _ => Reply::Child(at as u8 - 3),
            };
            at += 1;
        }
        all
    };
    &ALL[..3 + count.min(MOST_CHOICES)]
}

/// Replies of a supervisor that has so many moves.
pub(super) fn moves(count: usize) -> &'static [Reply] {
    const ALL: [Reply; MOST_MOVES + 1] = {
        let mut all = [Reply::Rest; MOST_MOVES + 1];
        let mut at = 0;
        while at < MOST_MOVES {
            all[at + 1] = Reply::Net(at as u8);
            at += 1;
        }
        all
    };
    &ALL[..=count.min(MOST_MOVES)]
}

impl Reply {
    /// Returns the letter of traces; moves of a supervisor have names instead.
    pub fn letter(self) -> char {
        match self {
            Reply::Leaf(it) => it.letter(),
            Reply::Yes => 'T',
            Reply::No => 'N',
            Reply::Rest => '-',
            Reply::Net(_) => '+',
            Reply::Child(it) => char::from_digit(it as u32 + 1, 10).unwrap_or('?'),
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
            '1'..='9' => Reply::Child(letter as u8 - b'1'),
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
    /// The node that asks; one more than the last is the supervisor.
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
    /// The supervisor made one of its moves, `(move)`.
    Moved(u8),
    /// Time let transitions of the supervisor fire, `[transitions]`: the number of their list.
    Passed(u32),
    /// A leaf started or stopped something in the supervisor, `>`; whether it was accepted.
    Offered(u32, Part, bool),
}

impl Event {
    /// Returns the node, unless it is the supervisor's own.
    pub fn node(self) -> Option<usize> {
        match self {
            Event::Asked(node, ..)
            | Event::Itself(node, _)
            | Event::Halted(node)
            | Event::Offered(node, ..) => Some(node as usize),
            Event::Moved(_) | Event::Passed(_) => None,
        }
    }

    /// Writes the event with the node's label.
    pub fn shown(self, tree: &Tree) -> String {
        let label = self.node().map_or("", |it| &tree.nodes[it].label);
        let bonds = tree.bonds.as_deref();
        match self {
            Event::Asked(_, how, reply) => format!("{label}{}{}", how.sign(), reply.letter()),
            Event::Itself(_, answer) => format!("{label}={}", answer.letter()),
            Event::Halted(_) => format!("{label}!"),
            Event::Moved(it) => format!("({})", bonds.map_or("?", |bonds| bonds.of_move(it))),
            Event::Passed(list) => {
                format!("[{}]", bonds.map_or_else(String::new, |bonds| bonds.fired(list)))
            }
            Event::Offered(node, part, accepted) => {
                let event = bonds.and_then(|it| it.offered(node as usize, part)).unwrap_or("?");
                format!("{label}>{event}{}", if accepted { "" } else { ":ignored" })
            }
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
    /// The tree was halted: from outside, or by the supervisor before a tick, which ends the run.
    Halted,
}
