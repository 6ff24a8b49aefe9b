//! Halting that ticks: a `TryCatch` that is halted ticks its last child, whose leaves may be asked.
//!
//! Halting is no step of the walk through a tree, and cannot stop at a question. So the machine
//! goes back to where the way to this question began, keeps the replies that were given since, and
//! does all of it again with one reply more: what it did before, it does again.

use super::{Cursor, Event, Fault, How, Machine, Question, Reply, Stop, controls, words};
use crate::tree::{Kind, Tree};
use std::collections::{BTreeMap, VecDeque};

/// Beginning of a way to a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum From {
    /// A tick of the root.
    Tick,
    /// A reply to the question of a node.
    Reply(usize, Reply),
    /// Halting from outside.
    Halt,
}

/// A way to a question within halting, and the manner in which the node asks.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Way {
    from: From,
    replies: Vec<Reply>,
    how: How,
}

/// Ways to questions, by number.
pub(super) struct Catching {
    /// The cell that holds the number of the way, from 1, where a node asks within halting.
    cell: usize,
    ways: Vec<Way>,
    numbers: BTreeMap<Way, u32>,
    /// Replies that are given again.
    given: VecDeque<Reply>,
    /// Events before this way.
    events: usize,
    /// The node that asks, and how: all of this way is taken back.
    asks: Option<(usize, How)>,
}

/// A machine as it was.
struct Before {
    cells: Vec<u32>,
    entries: Vec<u32>,
    dates: Vec<i64>,
    wake: bool,
}

/// Returns whether a node of a tree ticks when it is halted.
pub(crate) fn catches(tree: &Tree) -> bool {
    tree.nodes.iter().any(|it| it.kind == Kind::TryCatch { on_halt: true })
}

impl Machine<'_> {
    /// Makes the cell of ways, where a node needs it.
    pub(super) fn catching(&mut self) {
        if catches(self.tree) {
            self.catching = Some(Catching {
                cell: self.cells.len(),
                ways: Vec::new(),
                numbers: BTreeMap::new(),
                given: VecDeque::new(),
                events: 0,
                asks: None,
            });
            self.cells.push(0);
            self.layout.widths.push(32);
        }
    }

    fn way(&self) -> Option<&Way> {
        let it = self.catching.as_ref()?;
        it.ways.get((self.cells[it.cell] as usize).checked_sub(1)?)
    }

    /// Returns the question of the node that asks.
    pub fn question(&self) -> Option<Question> {
        let node = self.at?;
        let question = self.question_of(node);
        Some(match self.way() {
            Some(way) => Question { how: way.how, ..question },
            None => question,
        })
    }

    /// Halts the whole tree, as the library does: the root, then every node once more. May stop at
    /// a question; where it throws, a destructor aborts the process.
    pub fn halt_tree(&mut self) -> Stop {
        self.begin(From::Halt, Vec::new())
    }

    /// Gives the reply to the question at which a tick or halting stopped.
    ///
    /// # Panics
    ///
    /// Panics if the tree does not ask, or does not allow this reply.
    pub fn reply(&mut self, reply: Reply) -> Stop {
        let question = self.question().expect("a tree that asks");
        assert!(question.replies.contains(&reply), "a reply that is allowed");
        self.at = None;
        let Some(Way { from, mut replies, .. }) = self.way().cloned() else {
            return self.begin(From::Reply(question.node, reply), Vec::new());
        };
        replies.push(reply);
        self.begin(from, replies)
    }

    /// Goes on to the next question; those within halting that were answered are not asked again.
    pub(super) fn begin(&mut self, from: From, replies: Vec<Reply>) -> Stop {
        let Some(catching) = &mut self.catching else { return self.go(from) };
        self.cells[catching.cell] = 0;
        catching.given = replies.iter().copied().collect();
        catching.events = self.events.len();
        let before = Before {
            cells: self.cells.clone(),
            entries: self.entries.clone(),
            dates: self.dates.clone(),
            wake: self.wake,
        };
        let stop = self.go(from);
        let Some(catching) = &mut self.catching else { return stop };
        let Some((node, how)) = catching.asks.take() else { return stop };
        let way = Way { from, replies, how };
        let next = catching.ways.len() as u32 + 1;
        let number = *catching.numbers.entry(way.clone()).or_insert(next);
        if number == next {
            catching.ways.push(way);
        }
        let cell = catching.cell;
        (self.cells, self.dates, self.wake) = (before.cells, before.dates, before.wake);
        // Entries may have got numbers since; they did not exist before.
        self.entries = before.entries;
        self.entries.resize(self.store.entries.len(), 0);
        self.cells[cell] = number;
        self.at = Some(node);
        self.named = None;
        self.question().map_or(stop, Stop::Asked)
    }

    /// Asks on the way through a tick; within halting goes on with a reply that was given before.
    pub(super) fn asked(&mut self, node: usize, is_halting: bool) -> Result<Cursor, Stop> {
        if !is_halting {
            return Err(self.ask(node));
        }
        let question = self.question_of(node);
        let Some(catching) = &mut self.catching else { return Err(Stop::Asked(question)) };
        let Some(reply) = catching.given.pop_front() else {
            catching.asks = Some((node, question.how));
            return Err(Stop::Asked(question));
        };
        if catching.given.is_empty() {
            self.events.truncate(catching.events);
        }
        self.events.push(Event::Asked(node as u32, question.how, reply));
        Ok(self.replied(node, reply))
    }

    /// Ticks the child that catches, in the midst of halting its parent.
    pub(super) fn catch(&mut self, node: usize) -> Result<(), Fault> {
        if !self.is_active(node) || self.get(node, controls::CATCHING) == 1 {
            return Ok(());
        }
        let Some((&last, others)) = self.children(node).split_last() else { return Ok(()) };
        for &child in others {
            self.reset(child)?;
        }
        match self.run(Cursor::Enter(last), Some(last)) {
            Stop::Thrown(thrown) => {
                // A guard of the child throws in whoever halts.
                self.named = thrown.node.filter(|it| *it != node);
                return Err(Fault(thrown.why));
            }
            Stop::Asked(_) => return Err(Fault("halting asks".to_owned())),
            Stop::Answered(_) | Stop::Halted => {}
        }
        // What runs then is halted with all children of the node.
        Ok(())
    }

    /// Returns an exception, and the node that is named.
    pub(super) fn thrown(&mut self, node: Option<usize>, fault: Fault) -> Stop {
        let node = self.named.take().or(node);
        Stop::Thrown(words::Thrown { node, why: fault.0 })
    }
}
