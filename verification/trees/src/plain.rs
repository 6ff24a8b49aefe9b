//! A plain walk through all that a tree can do, by which explorations and certificates are checked.
//!
//! Shares the executor with the exploration, and nothing else: whole machines are kept, not packed
//! words; what goes on for ever is looked for by other code. It is slow and short on purpose.

mod endless;
mod graph;

use crate::explore::{Assumptions, Condition, End, Property};
use crate::findings::Wishes;
use crate::machine::{Event, How, Machine, Question, Reply, Status, Stop, Watched, catches};
use crate::supervisor::Part;
use crate::tree::{Answer, Tree};
use graph::{Edge, Graph, What};
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// Cells and entries.
type State = (Vec<u32>, Vec<u32>);
/// The same within a tick, with the node that asks and whether a wake-up is pending.
type Within = (State, Option<usize>, bool);
/// Pairs of nodes, with the fewest ticks until they are seen.
type Pairs = BTreeMap<(usize, usize), u32>;

/// Results of a walk.
#[derive(Clone, Debug, Default)]
pub struct Plain {
    /// States between ticks.
    pub states: usize,
    /// The ends of a run, and the fewest ticks.
    pub ends: BTreeMap<End, u32>,
    /// States from which no end can be reached.
    pub stuck: usize,
    /// Whether a fair run never ends.
    pub forever: bool,
    /// Actions that a fair run starts again and again without an end.
    pub restarted: Vec<usize>,
    /// Leaves that are asked before an entry that they read was written.
    pub early: BTreeSet<(usize, String)>,
    /// Whether wake-ups can follow each other for ever.
    pub spins: bool,
    /// Whether halting throws in some state.
    pub halting_throws: bool,
    /// Child and control node that fails at once upon its SUCCESS.
    pub lost: Pairs,
    /// Two actions that run at the end of a tick.
    pub both: Pairs,
    /// An action that starts, and one that runs.
    pub overlap: Pairs,
    /// Leaves whose event the supervisor ignores.
    pub refused: BTreeMap<(usize, Part), u32>,
    /// Answers of each node, as bits: SUCCESS, FAILURE, RUNNING, SKIPPED.
    pub said: Vec<u8>,
    /// Whether the own property holds.
    pub holds: Option<bool>,
}

struct Walk<'t, 'w> {
    machine: Machine<'t>,
    assumptions: Assumptions,
    wishes: &'w Wishes,
    /// Conditions that are looked at after each tick.
    conditions: Vec<&'w Condition>,
    actions: Vec<usize>,
    graph: Graph,
    /// States between ticks, in the order in which they were found.
    states: Vec<usize>,
    found: Plain,
}

/// Questions of all ticks, for each state that is allowed.
const QUESTIONS: usize = 20;

/// Walks through all states of a tree, at most so many; returns nothing where there are more, or
/// more than 20 times as many questions.
pub fn walk(
    tree: &Tree,
    wishes: &Wishes,
    property: Option<&Property>,
    most: usize,
) -> Option<Plain> {
    let mut machine = Machine::new(tree);
    let conditions = match property {
        Some(Property::Always(p) | Property::Sometime(p) | Property::Finally(p)) => vec![p],
        Some(Property::Follows(p, q)) => vec![q, p],
        None => Vec::new(),
    };
    let mut watched = Watched::default();
    conditions.iter().for_each(|it| it.watched(&mut watched));
    machine.watch(&watched);
    let mut assumptions = wishes.assumptions.clone();
    assumptions.reserve(&mut machine);
    let actions = (0..tree.nodes.len()).filter(|it| tree.nodes[*it].is_action()).collect();
    let mut walk = Walk {
        machine,
        assumptions,
        wishes,
        conditions,
        actions,
        graph: Graph::default(),
        states: Vec::new(),
        found: Plain::default(),
    };
    let (start, _) = walk.point(What::State, 0, 0);
    walk.states.push(start);
    let mut at = 0;
    while at < walk.states.len() {
        let full = walk.states.len() > most || walk.graph.points.len() > most * (QUESTIONS + 1);
        if full {
            return None;
        }
        walk.ticks(walk.states[at]);
        at += 1;
    }
    walk.judge();
    walk.found.holds = property.map(|it| walk.holds(it));
    Some(walk.found)
}

fn snapshot(machine: &Machine) -> State {
    let mut entries = machine.entries.clone();
    while entries.last() == Some(&0) {
        entries.pop();
    }
    (machine.cells.clone(), entries)
}

impl Walk<'_, '_> {
    /// Returns the number of the machine as it is, and whether it is new.
    fn point(&mut self, what: What, holds: u8, ticks: u32) -> (usize, bool) {
        let within = match what {
            What::End => ((vec![holds as u32], Vec::new()), None, true),
            _ => (snapshot(&self.machine), self.machine.at, self.machine.wake),
        };
        self.graph.add(what, &within, holds, ticks)
    }

    fn put(&mut self, (state, at, wake): Within) {
        (self.machine.cells, self.machine.entries) = state;
        self.machine.entries.resize(self.machine.store.entries.len(), 0);
        (self.machine.at, self.machine.wake) = (at, wake);
        self.machine.events.clear();
        self.machine.lost.clear();
        self.machine.refused.clear();
        self.machine.begun.clear();
    }

    /// Ticks a state in all ways, up to questions that were asked before.
    fn ticks(&mut self, from: usize) {
        let ((cells, entries), ..) = self.graph.within(from);
        self.put(((cells, entries), None, false));
        for cell in self.machine.watched.iter().flatten() {
            self.machine.cells[*cell] = 0;
        }
        let mut open = Vec::new();
        let stop = self.machine.tick();
        self.stopped(from, None, stop, &mut open);
        while let Some(point) = open.pop() {
            let within = self.graph.within(point);
            self.put(within.clone());
            let Some(question) = self.machine.question() else { continue };
            for &reply in question.replies {
                if !self.allows(question.node, reply, &within.0.0) {
                    continue;
                }
                self.put(within.clone());
                if self.machine.is_idle(reply) {
                    continue;
                }
                if reply == Reply::Leaf(Answer::Success) {
                    self.assumptions.written(question.node, &mut self.machine.cells);
                }
                let stop = self.machine.reply(reply);
                self.stopped(point, Some(reply), stop, &mut open);
            }
        }
    }

    fn allows(&mut self, node: usize, reply: Reply, cells: &[u32]) -> bool {
        let skipped = reply == Reply::Leaf(Answer::Skipped) && !self.wishes.skips;
        !skipped && self.assumptions.allows(node, reply, cells)
    }

    /// Notes where a tick has stopped.
    fn stopped(&mut self, from: usize, reply: Option<Reply>, stop: Stop, open: &mut Vec<usize>) {
        let ticks = self.graph.points[from].ticks + 1;
        for event in &self.machine.events {
            if let (Event::Itself(node, Answer::Success), true) =
                (*event, self.machine.tree().bonds.is_some())
            {
                self.assumptions.written(node as usize, &mut self.machine.cells);
            }
        }
        for (child, node) in std::mem::take(&mut self.machine.lost) {
            least(&mut self.found.lost, (child as usize, node as usize), ticks);
        }
        for it in std::mem::take(&mut self.machine.refused) {
            least(&mut self.found.refused, (it.node, it.part), ticks);
        }
        for (node, other) in std::mem::take(&mut self.machine.begun) {
            least(&mut self.found.overlap, (node as usize, other as usize), ticks);
        }
        let events = self.graph.list(&self.machine.events);
        let end = match stop {
            Stop::Asked(question) => {
                self.starts(question, ticks);
                let what = What::Asks(question.node, question.how);
                let (to, new) = self.point(what, 0, ticks - 1);
                if new {
                    open.push(to);
                }
                let edge = Edge { to, reply, events, wakes: false };
                return self.graph.points[from].edges.push(edge);
            }
            Stop::Answered(Answer::Running) => None,
            Stop::Answered(it) => Some(End::Answered(it)),
            Stop::Thrown(it) => Some(End::Thrown(it.node)),
            Stop::Halted => Some(End::Halted),
        };
        let mut holds = 0;
        for (bit, it) in self.conditions.iter().enumerate() {
            holds |= (it.holds(&self.machine, end.is_some()) as u8) << bit;
        }
        let wakes = self.machine.wake;
        let what = if end.is_some() { What::End } else { What::State };
        self.machine.wake = false;
        let (to, new) = self.point(what, holds, ticks);
        self.graph.points[from].edges.push(Edge { to, reply, events, wakes });
        if let Some(end) = end {
            return least(&mut self.found.ends, end, ticks);
        }
        if !new {
            return;
        }
        self.states.push(to);
        let runs: Vec<_> = self.running().collect();
        for (at, &one) in runs.iter().enumerate() {
            for &two in &runs[at + 1..] {
                least(&mut self.found.both, (one, two), ticks);
            }
        }
    }

    fn running(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.actions.iter().copied();
        all.filter(|it| self.machine.status(*it) == Status::Running)
    }

    fn starts(&mut self, question: Question, ticks: u32) {
        let node = question.node;
        if question.how != How::Starts || !self.actions.contains(&node) {
            return;
        }
        for other in self.running().filter(|it| *it != node).collect::<Vec<_>>() {
            least(&mut self.found.overlap, (node, other), ticks);
        }
    }

    /// Answers what is asked of all states together.
    fn judge(&mut self) {
        self.found.states = self.states.len();
        self.found.said.clone_from(&self.machine.said);
        let can = self.graph.can_end();
        self.found.stuck = self.states.iter().filter(|it| !can[**it]).count();
        self.found.spins = self.spins();
        self.found.forever = self.goes_on_forever();
        self.found.restarted = self.restarted();
        self.found.early = self.early();
        let tree = self.machine.tree();
        let halts = tree.nodes.iter().any(|it| it.afterwards.on_halted.is_some()) || catches(tree);
        for at in 0..if halts { self.states.len() } else { 0 } {
            self.halts(self.states[at]);
        }
    }

    /// Halts a state in all ways.
    fn halts(&mut self, state: usize) {
        self.put(self.graph.within(state));
        let (mut open, mut known) = (Vec::new(), HashSet::new());
        let mut stop = self.machine.halt_tree();
        loop {
            match stop {
                Stop::Thrown(_) => self.found.halting_throws = true,
                Stop::Asked(question) => {
                    let within = (snapshot(&self.machine), self.machine.at, self.machine.wake);
                    if known.insert(within.clone()) {
                        open.extend(question.replies.iter().map(|it| (within.clone(), *it)));
                    }
                }
                Stop::Answered(_) | Stop::Halted => {}
            }
            stop = loop {
                let Some((within, reply)) = open.pop() else { return };
                let node = within.1.unwrap_or_default();
                if self.allows(node, reply, &within.0.0) {
                    self.put(within);
                    break self.machine.reply(reply);
                }
            };
        }
    }
}

fn least<K: Ord>(map: &mut BTreeMap<K, u32>, key: K, ticks: u32) {
    let known = map.entry(key).or_insert(ticks);
    *known = ticks.min(*known);
}
