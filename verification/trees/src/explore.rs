//! All that a tree can do when the world answers as it likes.
//!
//! A *state* is what nodes, memories and blackboards hold between two ticks; a *question* is a
//! state within a tick in which the world is asked. Equal questions are one, whatever led to them:
//! a tick with a thousand ways through it costs what its questions cost. One run begins with a
//! fresh tree and goes to the first answer of the root other than RUNNING.

mod arrivals;
mod assume;
mod condition;
mod cycles;
mod facts;
mod graph;
mod halting;
mod keys;
mod minimal;
mod pack;
mod property;
mod runs;
mod unwritten;

use crate::machine::{Event, How, Machine, Question, Reply, Status, Vain, Watched};
use crate::supervisor::Part;
use crate::tree::{Answer, Tree};
use arrivals::Arrivals;
pub use assume::{Assumption, Assumptions, parse_assumption};
pub use condition::Condition;
pub use facts::{Early, Facts, InVain, Pair};
use graph::{Edge, MAX_SEQUENCES, What};
pub use graph::{End, Point};
use keys::{Keys, MAX_KEYS, Sequences};
use pack::Pack;
pub use property::{Property, Refused, Verdict, check_property, parse_property};
pub use runs::{Run, Step};
use std::collections::{BTreeMap, VecDeque};

/// How far an exploration goes.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// States between ticks.
    pub states: usize,
    /// States and questions.
    pub nodes: usize,
    /// Bytes of the graph.
    pub bytes: usize,
}

/// 30 million states and questions, 2 GiB.
impl Default for Limits {
    fn default() -> Limits {
        Limits { states: usize::MAX, nodes: 30_000_000, bytes: 2 << 30 }
    }
}

/// Something seen first at an edge: ticks so far, source, number of the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    pub(crate) ticks: u32,
    pub(crate) node: u32,
    pub(crate) edge: u32,
}

/// All behaviours of a tree, as far as the limits allow.
pub struct Space<'t> {
    pub(crate) tree: &'t Tree,
    machine: Machine<'t>,
    pack: Pack,
    keys: Keys,
    pub(crate) sequences: Sequences,
    what: Vec<u32>,
    pub(crate) level: Vec<u32>,
    /// Edge by which a point was found: source, edge.
    via: Vec<(u32, u32)>,
    first: Vec<u32>,
    count: Vec<u8>,
    pub(crate) edges: Vec<Edge>,
    assumptions: Assumptions,
    /// Child and control node that fails at once upon the child's SUCCESS.
    pub(crate) lost: BTreeMap<(usize, usize), Seen>,
    /// Two actions that run at the end of a tick.
    pub(crate) both: BTreeMap<(usize, usize), Seen>,
    /// An action that starts, and one that still runs.
    pub(crate) overlap: BTreeMap<(usize, usize), Seen>,
    /// Events that leaves offer to the supervisor in vain.
    pub(crate) refused: BTreeMap<(usize, Part), (Vain, Seen)>,
    /// Why exceptions were thrown, by end, the first time.
    pub(crate) causes: BTreeMap<End, String>,
    complete: bool,
    /// Leaves may answer SKIPPED.
    skips: bool,
    /// Ends by their codes, where nothing is watched.
    ends: Vec<Option<u32>>,
    /// Actions, and which pairs of them were seen, to run and to start.
    actions: Vec<usize>,
    met: Vec<[bool; 2]>,
    /// Edges of a point whose targets are not looked up yet.
    arrivals: Arrivals,
}

impl<'t> Space<'t> {
    /// Explores a tree; leaves answer what they may, K only with `skips`.
    pub fn explore(
        tree: &'t Tree,
        skips: bool,
        assumptions: Assumptions,
        limits: Limits,
    ) -> Space<'t> {
        Space::watching(tree, skips, assumptions, &Watched::default(), limits)
    }

    /// Explores a tree and keeps what is watched of the last tick.
    pub(crate) fn watching(
        tree: &'t Tree,
        skips: bool,
        mut assumptions: Assumptions,
        watched: &Watched,
        limits: Limits,
    ) -> Space<'t> {
        let mut machine = Machine::new(tree);
        machine.watch(watched);
        assumptions.reserve(&mut machine);
        let mut pack = Pack::of(tree, &machine.layout);
        pack.watches = !watched.is_empty();
        let nodes = tree.nodes.iter().enumerate();
        let actions: Vec<_> = nodes.filter(|it| it.1.is_action()).map(|it| it.0).collect();
        let mut space = Space {
            tree,
            keys: Keys::new(pack.words),
            machine,
            pack,
            sequences: Sequences::default(),
            what: Vec::new(),
            level: Vec::new(),
            via: Vec::new(),
            first: Vec::new(),
            count: Vec::new(),
            edges: Vec::new(),
            assumptions,
            lost: BTreeMap::new(),
            both: BTreeMap::new(),
            overlap: BTreeMap::new(),
            refused: BTreeMap::new(),
            causes: BTreeMap::new(),
            complete: true,
            skips,
            ends: Vec::new(),
            met: vec![[false; 2]; actions.len() * actions.len()],
            actions,
            arrivals: Arrivals::default(),
        };
        space.run(limits);
        space
    }

    /// Returns whether everything was explored.
    pub fn is_complete(&self) -> bool {
        self.complete
    }

    /// Returns the numbers of states, questions and edges.
    pub fn size(&self) -> (usize, usize, usize) {
        let states = self.what.iter().filter(|it| **it == 0).count();
        let asks = self.what.iter().filter(|it| (1..=self.asks()).contains(*it)).count();
        (states, asks, self.edges.len())
    }

    /// Returns the assumptions, with whether each was of use.
    pub fn assumptions(&self) -> &Assumptions {
        &self.assumptions
    }

    fn asks(&self) -> u32 {
        self.tree.nodes.len() as u32 + self.tree.bonds.is_some() as u32
    }

    pub(crate) fn len(&self) -> usize {
        self.what.len()
    }

    pub(crate) fn what(&self, point: usize) -> What {
        let asks = self.asks();
        match self.what[point] {
            0 => What::State,
            it if it <= asks => What::Asks(it as usize - 1),
            it => What::End(match it - asks - 1 {
                0 => End::Answered(Answer::Success),
                1 => End::Answered(Answer::Failure),
                2 => End::Answered(Answer::Skipped),
                3 => End::Thrown(None),
                it if it as usize == self.tree.nodes.len() + 4 => End::Halted,
                it => End::Thrown(Some(it as usize - 4)),
            }),
        }
    }

    pub(crate) fn is_state(&self, point: usize) -> bool {
        self.what[point] == 0
    }

    /// Returns the edges of a point; there are none where a limit was met.
    pub(crate) fn out(&self, point: usize) -> std::ops::Range<usize> {
        let first = self.first[point] as usize;
        first..first + self.count[point] as usize
    }

    pub(crate) fn via(&self, point: usize) -> Option<(usize, usize)> {
        (point > 0).then(|| (self.via[point].0 as usize, self.via[point].1 as usize))
    }

    /// Returns answers of each node so far, as bits.
    pub(crate) fn said(&self) -> &[u8] {
        &self.machine.said
    }

    /// Returns the machine as it was at a point.
    pub(crate) fn at(&mut self, point: usize) -> &mut Machine<'t> {
        self.pack.load(self.keys.get(point), &mut self.machine);
        &mut self.machine
    }

    fn run(&mut self, limits: Limits) {
        self.machine.at = None;
        self.pack.store(&mut self.machine, 0);
        self.begin();
        let mut waiting = VecDeque::from([0_u32]);
        let mut work = VecDeque::new();
        let mut base = Vec::new();
        let mut states = 0;
        while let Some(state) = waiting.pop_front() {
            states += 1;
            if states > limits.states {
                self.complete = false;
                return;
            }
            work.push_back(state);
            // With a supervisor there are many ways to one point before a tick: the shortest first.
            let first = self.tree.bonds.is_some();
            while let Some(point) = if first { work.pop_front() } else { work.pop_back() } {
                let full = self.sequences.len() >= MAX_SEQUENCES || self.pack.overflows;
                if self.len() > limits.nodes.min(MAX_KEYS - 256)
                    || self.bytes() > limits.bytes
                    || full
                {
                    self.complete = false;
                    return;
                }
                self.expand(point as usize, &mut base, &mut waiting, &mut work);
            }
        }
    }

    /// Returns the bytes that the graph takes.
    pub fn bytes(&self) -> usize {
        self.keys.bytes() + self.len() * 21 + self.edges.len() * size_of::<Edge>()
    }

    fn expand(
        &mut self,
        point: usize,
        base: &mut Vec<u32>,
        waiting: &mut VecDeque<u32>,
        work: &mut VecDeque<u32>,
    ) {
        self.pack.load(self.keys.get(point), &mut self.machine);
        self.first[point] = self.edges.len() as u32;
        let Some(question) = self.machine.question() else {
            for cell in self.machine.watched.iter().flatten() {
                self.machine.cells[*cell] = 0;
            }
            self.machine.wake = false;
            self.machine.events.clear();
            let stop = self.machine.tick();
            self.bound_written();
            self.arrive(point, None, stop);
            return self.settle(point, waiting, work);
        };
        base.clone_from(&self.machine.cells);
        let (entries, wake) = (self.machine.entries.clone(), self.machine.wake);
        for &reply in question.replies {
            if reply == Reply::Leaf(Answer::Skipped) && !self.skips {
                continue;
            }
            if !self.assumptions.allows(question.node, reply, base) {
                continue;
            }
            self.machine.cells.copy_from_slice(base);
            self.machine.entries.clone_from(&entries);
            self.machine.entries.resize(self.machine.store.entries.len(), 0);
            self.machine.wake = wake;
            self.machine.at = Some(question.node);
            self.machine.events.clear();
            if self.machine.is_idle(reply) {
                continue;
            }
            if reply == Reply::Leaf(Answer::Success) {
                self.assumptions.written(question.node, &mut self.machine.cells);
            }
            let stop = self.machine.reply(reply);
            self.bound_written();
            self.arrive(point, Some(reply), stop);
        }
        self.settle(point, waiting, work);
    }

    /// Notes what leaves have written that act on the supervisor, and are not asked.
    fn bound_written(&mut self) {
        if self.tree.bonds.is_none() {
            return;
        }
        for event in &self.machine.events {
            if let Event::Itself(node, Answer::Success) = *event {
                self.assumptions.written(node as usize, &mut self.machine.cells);
            }
        }
    }

    pub(crate) fn running(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.actions.iter().copied();
        all.filter(|it| self.machine.status(*it) == Status::Running)
    }

    /// Returns whether two actions meet for the first time, by their places in the list.
    fn meet(&mut self, a: usize, b: usize, how: usize) -> bool {
        let met = &mut self.met[a * self.actions.len() + b][how];
        !std::mem::replace(met, true)
    }

    fn look_at_question(&mut self, question: Question, seen: Seen) {
        let place = self.actions.binary_search(&question.node);
        let (How::Starts, Ok(starts)) = (question.how, place) else { return };
        for at in 0..self.actions.len() {
            let other = self.actions[at];
            if other != question.node
                && self.machine.status(other) == Status::Running
                && self.meet(starts, at, 1)
            {
                self.overlap.insert((question.node, other), seen);
            }
        }
    }

    fn look_at_state(&mut self, seen: Seen) {
        for one in 0..self.actions.len() {
            if self.machine.status(self.actions[one]) != Status::Running {
                continue;
            }
            for two in one + 1..self.actions.len() {
                let running = self.machine.status(self.actions[two]) == Status::Running;
                if running && self.meet(one, two, 0) {
                    self.both.insert((self.actions[one], self.actions[two]), seen);
                }
            }
        }
    }

    /// Returns why an exception was thrown, the first time.
    pub fn cause(&self, end: End) -> Option<String> {
        self.causes.get(&end).cloned()
    }

    /// Returns the events of an edge.
    pub(crate) fn events(&self, edge: usize) -> &[Event] {
        self.sequences.get(self.edges[edge].events())
    }
}
