//! The supervisor beside a tree: its own moves before a tick, and leaves that act on it.

use super::{Event, How, Machine, Move, Question, Reply, Status, Stop, words};
use crate::supervisor::{Acts, Bond, Bonds, Part, Sight, Taken, When, waited_for, waits};
use crate::tree::{Answer, Tree};

/// Cells of a supervisor.
pub(super) struct Beside {
    /// The state of the supervisor; the next cell says that a timer has gone off before this tick.
    cell: usize,
    /// For each leaf that waits for transitions, the cell that notes those that fired.
    latches: Vec<Option<usize>>,
    /// The cell that notes a transition upon which the tree is halted, where one is waited for.
    cancelled: Option<usize>,
    /// A property asks for its places.
    watched: bool,
}

/// An event that a leaf offered in vain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vain {
    /// The leaf.
    pub node: usize,
    /// The part of its life.
    pub part: Part,
    /// State of the supervisor.
    pub state: u32,
}

impl<'t> Machine<'t> {
    /// Returns the tree.
    pub fn tree(&self) -> &'t Tree {
        self.tree
    }

    /// Makes the cells of the supervisor, if there is one.
    pub(super) fn beside(&mut self) {
        let Some(bonds) = self.bonds() else { return };
        let cell = self.cells.len();
        self.cells.extend([0, 0]);
        let states = bonds.net.states.saturating_sub(1);
        self.layout.widths.extend([super::cells::bits(states).max(1), 1]);
        let latches = bonds.of.iter().map(|it| {
            let Some(Bond::Acts(acts)) = it else { return None };
            acts.ends().into_iter().any(waits).then(|| {
                self.cells.push(0);
                self.layout.widths.push(2);
                self.cells.len() - 1
            })
        });
        let latches = latches.collect();
        let cancelled = waits(&bonds.cancels).then(|| {
            self.cells.push(0);
            self.layout.widths.push(1);
            self.cells.len() - 1
        });
        self.beside = Some(Beside { cell, latches, cancelled, watched: false });
    }

    pub(super) fn bonds(&self) -> Option<&'t Bonds> {
        let tree: &'t Tree = self.tree;
        tree.bonds.as_deref()
    }

    /// Returns the state of the supervisor.
    pub(crate) fn stands(&self) -> u32 {
        self.beside.as_ref().map_or(0, |it| self.cells[it.cell])
    }

    /// Keeps the state of the supervisor where a run has ended.
    pub(super) fn watch_net(&mut self) {
        if let Some(it) = &mut self.beside {
            it.watched = true;
        }
    }

    /// Returns the cell of the supervisor, where a property asks for it.
    pub(crate) fn watched_net(&self) -> Option<usize> {
        self.beside.as_ref().filter(|it| it.watched).map(|it| it.cell)
    }

    /// Returns the marked places of the supervisor.
    pub fn marked(&self) -> Vec<&'t str> {
        self.bonds().map_or(Vec::new(), |it| it.net.marked(self.stands()))
    }

    /// Returns whether a place of the supervisor is marked.
    pub(crate) fn is_marked(&self, place: usize) -> bool {
        self.bonds().is_some_and(|it| it.net.is_marked(self.stands(), place))
    }

    /// Returns whether a reply is a move of the supervisor that changes nothing.
    pub fn is_idle(&self, reply: Reply) -> bool {
        match (reply, self.bonds()) {
            (Reply::Net(at), Some(bonds)) => bonds.is_idle(self.stands(), at),
            _ => false,
        }
    }

    /// Lets the time up to this tick pass in the supervisor.
    pub(super) fn pass(&mut self) {
        let Some(bonds) = self.bonds() else { return };
        let Some(event) = bonds.net.pass else { return };
        let fired = bonds.net.edge(self.stands(), event).fired;
        if fired > 0 {
            self.events.push(Event::Passed(fired));
        }
        self.happens(event, None);
    }

    /// Asks the supervisor, unless it has no move.
    pub(super) fn ask_net(&mut self) -> Option<Stop> {
        let bonds = self.bonds()?;
        let state = self.stands();
        let mut moves = (0..bonds.moves.len()).map(|it| it as u8);
        moves.find(|it| !bonds.is_idle(state, *it))?;
        self.at = Some(self.tree.nodes.len());
        self.question().map(Stop::Asked)
    }

    pub(super) fn question_of_net(&self) -> Question {
        let count = self.bonds().map_or(0, |it| it.moves.len());
        Question { node: self.tree.nodes.len(), how: How::Looks, replies: words::moves(count) }
    }

    /// Notes that a timer has gone off: the supervisor may move before the tick.
    pub(super) fn gone_off(&mut self) {
        if let Some(it) = &self.beside {
            self.cells[it.cell + 1] = 1;
        }
    }

    /// Returns and forgets whether a timer has gone off.
    pub(super) fn take_gone_off(&mut self) -> bool {
        match &self.beside {
            Some(it) => std::mem::take(&mut self.cells[it.cell + 1]) == 1,
            None => false,
        }
    }

    pub(super) fn has_gone_off(&self) -> bool {
        self.beside.as_ref().is_some_and(|it| self.cells[it.cell + 1] == 1)
    }

    /// Lets the supervisor make a move.
    pub(super) fn moved(&mut self, at: u8) {
        let Some(bonds) = self.bonds() else { return };
        let Some(&event) = bonds.moves.get(at as usize) else { return };
        self.events.push(Event::Moved(at));
        self.happens(event, None);
    }

    /// Lets an event happen, and notes for leaves that run, or start, what fired.
    fn happens(&mut self, event: usize, starts: Option<usize>) -> Taken {
        let (Some(bonds), Some(beside)) = (self.bonds(), &self.beside) else {
            return Taken::Ignored;
        };
        let (to, taken, fired) = bonds.net.offer(self.cells[beside.cell], event);
        self.cells[beside.cell] = to;
        if let Some(cell) = beside.cancelled {
            self.cells[cell] |= waited_for(&bonds.cancels, fired) as u32;
        }
        for (node, cell) in beside.latches.iter().enumerate() {
            let (Some(cell), Some(Bond::Acts(acts))) = (*cell, &bonds.of[node]) else { continue };
            if starts != Some(node) && self.cells[node] != Status::Running as u32 {
                continue;
            }
            for (bit, when) in acts.ends().into_iter().enumerate() {
                self.cells[cell] |= (waited_for(when, fired) as u32) << bit;
            }
        }
        taken
    }

    /// Offers the event by which a leaf starts or is halted; returns whether the leaf goes on.
    fn offer(&mut self, node: usize, acts: &Acts, part: Part, event: usize) -> bool {
        let state = self.stands();
        let has_ended = self.ended(node, acts).is_some();
        let taken = self.happens(event, (part == Part::Starts).then_some(node));
        self.events.push(Event::Offered(node as u32, part, taken == Taken::Fired));
        // To be left unanswered on purpose is no fault, nor to stop what has ended.
        let is_meant = match part {
            Part::Starts => acts.tries,
            Part::Halts => has_ended,
        };
        if taken == Taken::Ignored && !is_meant {
            self.refused.push(Vain { node, part, state });
        }
        taken == Taken::Fired || taken == Taken::OnPurpose && !acts.tries
    }

    /// Returns the answer by which an action ends, if it does.
    fn ended(&self, node: usize, acts: &Acts) -> Option<Answer> {
        let is =
            |when: &Option<When>, bit| when.as_ref().is_some_and(|it| self.sees(node, it, bit));
        if is(&acts.fails, 1) {
            return Some(Answer::Failure);
        }
        let at_once = acts.succeeds.is_none() && acts.fails.is_none();
        (at_once || is(&acts.succeeds, 0)).then_some(Answer::Success)
    }

    fn forget_latch(&mut self, node: usize) {
        if let Some(Some(cell)) = self.beside.as_ref().map(|it| it.latches[node]) {
            self.cells[cell] = 0;
        }
    }

    fn sees(&self, node: usize, when: &When, bit: u32) -> bool {
        let latch = self.beside.as_ref().and_then(|it| it.latches[node]);
        self.is_seen(when, latch.is_some_and(|it| self.cells[it] >> bit & 1 == 1))
    }

    /// Returns whether a sight is so; `fired` says that a transition that is waited for has fired.
    fn is_seen(&self, when: &[Sight], fired: bool) -> bool {
        when.iter().any(|it| match it {
            Sight::At(place) => self.is_marked(*place),
            Sight::NotAt(place) => !self.is_marked(*place),
            Sight::After(_) => fired,
        })
    }

    /// Halts the tree if the supervisor cancels it.
    pub(super) fn cancelled(&mut self) -> Option<Stop> {
        let bonds = self.bonds()?;
        let noted = self.beside.as_ref().and_then(|it| it.cancelled);
        let is_so = self.is_seen(&bonds.cancels, noted.is_some_and(|it| self.cells[it] == 1));
        is_so.then(|| self.halt_all())
    }

    /// Ticks a leaf that is bound to the supervisor.
    pub(super) fn enter_bound(&mut self, node: usize, bond: &Bond) -> Move {
        let acts = match bond {
            Bond::Reads(when) => {
                let so = self.sees(node, when, 0);
                let answer = if so { Answer::Success } else { Answer::Failure };
                self.events.push(Event::Itself(node as u32, answer));
                return Move::Answer(answer);
            }
            Bond::Acts(acts) => acts,
        };
        let mut accepted = true;
        if self.status(node) != Status::Running {
            self.forget_latch(node);
            let nodes = self.tree.nodes.iter().enumerate();
            for (other, _) in nodes.filter(|it| it.0 != node && it.1.is_action()) {
                if self.cells[other] == Status::Running as u32 {
                    self.begun.push((node as u32, other as u32));
                }
            }
            if let Some(event) = acts.starts {
                accepted = self.offer(node, acts, Part::Starts, event);
            }
        }
        let answer = match self.ended(node, acts) {
            _ if !accepted => Answer::Failure,
            Some(answer) => answer,
            None => Answer::Running,
        };
        if answer != Answer::Running {
            self.forget_latch(node);
        }
        self.events.push(Event::Itself(node as u32, answer));
        Move::Answer(answer)
    }

    /// Halts what a leaf that ran has started.
    pub(super) fn halt_bound(&mut self, node: usize) {
        let Some(Bond::Acts(acts)) = self.tree.bond(node) else { return };
        if let Some(event) = acts.halts {
            self.offer(node, acts, Part::Halts, event);
        }
        self.forget_latch(node);
    }
}
