//! A plain walk through all that a tree can do, by which explorations and certificates are checked.
//!
//! Shares the executor with the exploration, and nothing else: whole machines are kept, not packed
//! words; each state's ticks are walked for themselves; there is no graph of questions. It is slow
//! and short on purpose.

use crate::explore::{Assumptions, Condition, End, Property};
use crate::machine::{How, Machine, Question, Reply, Status, Stop, Watched};
use crate::supervisor::Part;
use crate::tree::{Answer, Tree};
use std::collections::{BTreeMap, HashMap, HashSet, VecDeque};

/// Cells and entries between two ticks.
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
    /// Whether the condition of an own property held, and failed to hold, after some tick.
    pub held: [bool; 2],
}

struct Walk<'t, 'c> {
    machine: Machine<'t>,
    assumptions: Assumptions,
    skips: bool,
    condition: Option<&'c Condition>,
    actions: Vec<usize>,
    numbers: HashMap<State, u32>,
    states: Vec<State>,
    level: Vec<u32>,
    /// Edges to states, and whether each ends with a wake-up.
    next: Vec<Vec<(u32, bool)>>,
    /// States with an edge to an end.
    ends: Vec<bool>,
    questions: usize,
    found: Plain,
}

/// Questions of all ticks, for each state that is allowed.
const QUESTIONS: usize = 50;

/// Walks through all states of a tree, at most so many; returns nothing where there are more, or
/// more than 50 times as many questions.
///
/// An own property must be `AG p` or `EF p`.
pub fn walk(
    tree: &Tree,
    skips: bool,
    mut assumptions: Assumptions,
    property: Option<&Property>,
    most: usize,
) -> Option<Plain> {
    let mut machine = Machine::new(tree);
    let condition = match property {
        Some(Property::Always(it) | Property::Sometime(it)) => Some(it),
        Some(_) => return None,
        None => None,
    };
    let mut watched = Watched::default();
    condition.iter().for_each(|it| it.watched(&mut watched));
    machine.watch(&watched);
    assumptions.reserve(&mut machine);
    let actions = (0..tree.nodes.len()).filter(|it| tree.nodes[*it].is_action()).collect();
    let start = snapshot(&machine);
    let mut walk = Walk {
        machine,
        assumptions,
        skips,
        condition,
        actions,
        numbers: HashMap::new(),
        states: Vec::new(),
        level: Vec::new(),
        next: Vec::new(),
        ends: Vec::new(),
        questions: 0,
        found: Plain::default(),
    };
    walk.add(start, 0);
    let mut at = 0;
    while at < walk.states.len() {
        if walk.states.len() > most || !walk.ticks(at, most * QUESTIONS) {
            return None;
        }
        at += 1;
    }
    walk.judge();
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
    fn add(&mut self, state: State, level: u32) -> u32 {
        let next = self.states.len() as u32;
        let number = *self.numbers.entry(state.clone()).or_insert(next);
        if number == next {
            self.states.push(state);
            self.level.push(level);
            self.next.push(Vec::new());
            self.ends.push(false);
        }
        number
    }

    fn put(&mut self, (cells, entries): &State, at: Option<usize>, wake: bool) {
        self.machine.cells.clone_from(cells);
        self.machine.entries.clone_from(entries);
        self.machine.entries.resize(self.machine.store.entries.len(), 0);
        (self.machine.at, self.machine.wake) = (at, wake);
        self.machine.events.clear();
        self.machine.lost.clear();
        self.machine.refused.clear();
        self.machine.begun.clear();
    }

    /// Ticks a state in all ways; returns whether there were not too many.
    fn ticks(&mut self, from: usize, most: usize) -> bool {
        let state = self.states[from].clone();
        self.put(&state, None, false);
        for cell in self.machine.watched.iter().flatten() {
            self.machine.cells[*cell] = 0;
        }
        let (mut open, mut known) = (Vec::new(), HashSet::new());
        let stop = self.machine.tick();
        self.stopped(from, stop, &mut open, &mut known);
        while let Some((state, at, wake)) = open.pop() {
            self.put(&state, at, wake);
            let Some(question) = self.machine.question() else { continue };
            self.questions += 1;
            if self.questions > most {
                return false;
            }
            for &reply in question.replies {
                let skipped = reply == Reply::Leaf(Answer::Skipped) && !self.skips;
                if skipped || !self.assumptions.allows(question.node, reply, &state.0) {
                    continue;
                }
                self.put(&state, at, wake);
                if reply == Reply::Leaf(Answer::Success) {
                    self.assumptions.written(question.node, &mut self.machine.cells);
                }
                let stop = self.machine.reply(reply);
                self.stopped(from, stop, &mut open, &mut known);
            }
        }
        true
    }

    /// Notes where a tick has stopped.
    fn stopped(
        &mut self,
        from: usize,
        stop: Stop,
        open: &mut Vec<Within>,
        known: &mut HashSet<Within>,
    ) {
        let ticks = self.level[from] + 1;
        for (child, node) in std::mem::take(&mut self.machine.lost) {
            least(&mut self.found.lost, (child as usize, node as usize), ticks);
        }
        for it in std::mem::take(&mut self.machine.refused) {
            least(&mut self.found.refused, (it.node, it.part), ticks);
        }
        for (node, other) in std::mem::take(&mut self.machine.begun) {
            least(&mut self.found.overlap, (node as usize, other as usize), ticks);
        }
        let end = match stop {
            Stop::Asked(question) => {
                self.starts(question, ticks);
                let within = (snapshot(&self.machine), self.machine.at, self.machine.wake);
                if known.insert(within.clone()) {
                    open.push(within);
                }
                return;
            }
            Stop::Answered(Answer::Running) => None,
            Stop::Answered(it) => Some(End::Answered(it)),
            Stop::Thrown(it) => Some(End::Thrown(it.node)),
            Stop::Halted => Some(End::Halted),
        };
        if let Some(it) = self.condition {
            self.found.held[it.holds(&self.machine, end.is_some()) as usize] = true;
        }
        if let Some(end) = end {
            least(&mut self.found.ends, end, ticks);
            self.ends[from] = true;
            return;
        }
        let wakes = self.machine.wake;
        let runs = self.actions.iter().copied().filter(|it| self.runs(*it));
        let runs: Vec<_> = runs.collect();
        for (at, &one) in runs.iter().enumerate() {
            for &two in &runs[at + 1..] {
                least(&mut self.found.both, (one, two), ticks);
            }
        }
        let state = snapshot(&self.machine);
        let to = self.add(state, ticks);
        self.next[from].push((to, wakes));
    }

    fn runs(&self, node: usize) -> bool {
        self.machine.status(node) == Status::Running
    }

    fn starts(&mut self, question: Question, ticks: u32) {
        let node = question.node;
        if question.how != How::Starts || !self.actions.contains(&node) {
            return;
        }
        for at in 0..self.actions.len() {
            let other = self.actions[at];
            if other != node && self.runs(other) {
                least(&mut self.found.overlap, (node, other), ticks);
            }
        }
    }

    /// Answers what is asked of all states together.
    fn judge(&mut self) {
        self.found.states = self.states.len();
        self.found.said.clone_from(&self.machine.said);
        // From the states with an end backwards.
        let mut before = vec![Vec::new(); self.states.len()];
        for (from, next) in self.next.iter().enumerate() {
            next.iter().for_each(|it| before[it.0 as usize].push(from));
        }
        let mut can = self.ends.clone();
        let mut work: Vec<_> = (0..can.len()).filter(|it| can[*it]).collect();
        while let Some(at) = work.pop() {
            for &from in &before[at] {
                if !std::mem::replace(&mut can[from], true) {
                    work.push(from);
                }
            }
        }
        self.found.stuck = can.iter().filter(|it| !**it).count();
        // States that no wake-up leads to are taken away until none is left, or a circle.
        let mut into = vec![0; self.states.len()];
        let wakes = |next: &Vec<(u32, bool)>| {
            let all = next.iter().filter(|it| it.1);
            all.map(|it| it.0 as usize).collect::<HashSet<_>>()
        };
        let wakes: Vec<_> = self.next.iter().map(wakes).collect();
        wakes.iter().flatten().for_each(|it| into[*it] += 1);
        let mut work: VecDeque<_> = (0..into.len()).filter(|it| into[*it] == 0).collect();
        let mut left = into.len();
        while let Some(at) = work.pop_front() {
            left -= 1;
            for &to in &wakes[at] {
                into[to] -= 1;
                if into[to] == 0 {
                    work.push_back(to);
                }
            }
        }
        self.found.spins = left > 0;
        let halts = self.machine.tree.nodes.iter().any(|it| it.afterwards.on_halted.is_some());
        for at in 0..if halts { self.states.len() } else { 0 } {
            let state = self.states[at].clone();
            self.put(&state, None, false);
            self.found.halting_throws |= self.machine.halt_tree().is_err();
        }
    }
}

fn least<K: Ord>(map: &mut BTreeMap<K, u32>, key: K, ticks: u32) {
    let known = map.entry(key).or_insert(ticks);
    *known = ticks.min(*known);
}
