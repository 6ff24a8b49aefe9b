//! Runs without end, and entries read before they are written, by plain search.

use super::Walk;
use super::graph::{Edge, What};
use crate::explore::Property;
use crate::machine::{Event, How, Reply};
use crate::supervisor::Part;
use crate::tree::{Answer, Kind};
use std::collections::{BTreeSet, HashSet, VecDeque};

/// Bits of the condition that a property waits for, and of the one after which it does.
const WAITED: u8 = 1;
const AFTER: u8 = 2;

type Keep<'k> = &'k dyn Fn(&Edge) -> bool;

/// Returns whether a leaf ends by an event.
fn ends(event: Event, node: usize) -> bool {
    match event {
        Event::Asked(at, How::Starts | How::Goes, Reply::Leaf(it)) | Event::Itself(at, it) => {
            at as usize == node && matches!(it, Answer::Success | Answer::Failure)
        }
        _ => false,
    }
}

/// Returns whether a leaf begins to run by an event.
fn begins(event: Event, node: usize) -> bool {
    match event {
        Event::Asked(at, How::Starts, reply) => {
            at as usize == node && reply == Reply::Leaf(Answer::Running)
        }
        Event::Offered(at, Part::Starts, accepted) => at as usize == node && accepted,
        _ => false,
    }
}

/// Returns whether an action that runs does not go on for ever, if this happens ever again.
fn moves(event: Event, node: usize) -> bool {
    match event {
        Event::Asked(at, How::Goes, Reply::Leaf(Answer::Running)) if at as usize == node => false,
        Event::Asked(at, How::Starts | How::Goes, _)
        | Event::Halted(at)
        | Event::Offered(at, Part::Starts, _) => at as usize == node,
        Event::Itself(at, answer) => at as usize == node && answer != Answer::Running,
        _ => false,
    }
}

impl Walk<'_, '_> {
    fn has(&self, edge: &Edge, is: &dyn Fn(Event) -> bool) -> bool {
        self.graph.events(edge).iter().any(|it| is(*it))
    }

    fn all(&self) -> Vec<usize> {
        (0..self.graph.points.len()).collect()
    }

    /// Returns whether a tick can wake the next for ever.
    pub(super) fn spins(&self) -> bool {
        let is_state = |at: usize| self.graph.points[at].what == What::State;
        let wakes = |it: &Edge| it.wakes || !is_state(it.to);
        let circles = self.graph.circles(&self.all(), &wakes);
        circles.iter().any(|it| it.iter().any(|at| is_state(*at)))
    }

    pub(super) fn goes_on_forever(&mut self) -> bool {
        let circles = self.graph.circles(&self.all(), &|_| true);
        circles.iter().any(|it| self.is_fair(it, &|_| true, &|_| true))
    }

    pub(super) fn restarted(&mut self) -> Vec<usize> {
        let all = self.all();
        let mut restarted = Vec::new();
        for node in self.actions.clone() {
            let lists = |is: fn(Event, usize) -> bool| {
                let mut found = HashSet::new();
                for edge in self.graph.points.iter().flat_map(|it| &it.edges) {
                    if self.has(edge, &|it| is(it, node)) {
                        found.insert(edge.events);
                    }
                }
                found
            };
            let (ended, begun) = (lists(ends), lists(begins));
            let keep = |it: &Edge| !ended.contains(&it.events);
            let need = |it: &Edge| begun.contains(&it.events);
            let circles = self.graph.circles(&all, &keep);
            if circles.iter().any(|it| self.is_fair(it, &keep, &need)) {
                restarted.push(node);
            }
        }
        restarted
    }

    /// Returns whether a run can stay in a circle for ever, take a needed edge, and be fair: gates
    /// open, queues are empty, somebody chooses, no pause comes again and again, actions that run
    /// end or are halted.
    fn is_fair(&mut self, circle: &[usize], keep: Keep, need: Keep) -> bool {
        let inside: HashSet<usize> = circle.iter().copied().collect();
        let points = &self.graph.points;
        let edges = circle.iter().flat_map(|it| &points[*it].edges);
        let edges: Vec<Edge> =
            edges.filter(|it| inside.contains(&it.to) && keep(it)).copied().collect();
        let is_state = |at: &&usize| points[**at].what == What::State;
        let states: Vec<usize> = circle.iter().filter(is_state).copied().collect();
        if states.is_empty() || !edges.iter().any(need) {
            return false;
        }
        let looks = |edge: &Edge| {
            let all = self.graph.events(edge).iter().filter_map(|it| match *it {
                Event::Asked(node, How::Looks, reply) => Some((node, reply)),
                _ => None,
            });
            all.collect::<Vec<_>>()
        };
        let kinds = &self.machine.tree().nodes;
        let delays = |(node, reply): (u32, Reply)| match kinds.get(node as usize).map(|it| &it.kind)
        {
            Some(Kind::Loop { .. }) => reply == Reply::Yes,
            Some(Kind::ManualSelector { .. }) => reply == Reply::Leaf(Answer::Running),
            _ => reply == Reply::No,
        };
        let pauses = |node: u32| kinds[node as usize].kind == Kind::PauseResumeController;
        let all: Vec<_> = edges.iter().flat_map(looks).collect();
        let goes = |node: u32| all.iter().any(|it| it.0 == node && !delays(*it));
        let stays = all.iter().filter(|it| it.0 < kinds.len() as u32 && delays(**it));
        let stays = stays.filter(|it| pauses(it.0) || !goes(it.0));
        let stays: BTreeSet<u32> = stays.map(|it| it.0).collect();
        if !stays.is_empty() {
            // Without these replies the circle may fall into smaller ones.
            let closed: HashSet<usize> = edges
                .iter()
                .filter(|it| looks(it).into_iter().any(|it| stays.contains(&it.0) && delays(it)))
                .map(|it| it.events)
                .collect();
            let open = |it: &Edge| keep(it) && !closed.contains(&it.events);
            let parts = self.graph.circles(circle, &open);
            return parts.iter().any(|it| self.is_fair(it, &open, need));
        }
        let mut run: Vec<usize> = self.actions.clone();
        for state in states {
            self.put(self.graph.within(state));
            let now: Vec<usize> = self.running().collect();
            run.retain(|it| now.contains(it));
        }
        run.into_iter().all(|node| {
            let moves = |it: &Edge| self.has(it, &|it| moves(it, node));
            let is_bound = self.machine.tree().bond(node).is_some();
            edges.iter().any(moves) || is_bound && !self.may(circle, &moves)
        })
    }

    /// Returns whether an edge can be taken sooner or later.
    fn may(&self, from: &[usize], takes: &dyn Fn(&Edge) -> bool) -> bool {
        let mut known: HashSet<usize> = from.iter().copied().collect();
        let mut work = from.to_vec();
        while let Some(at) = work.pop() {
            for edge in &self.graph.points[at].edges {
                if takes(edge) {
                    return true;
                }
                if known.insert(edge.to) {
                    work.push(edge.to);
                }
            }
        }
        false
    }

    /// Returns the leaves, and loops, that are asked before an entry that they read was written.
    pub(super) fn early(&self) -> BTreeSet<(usize, String)> {
        let tree = self.machine.tree();
        let mut early = BTreeSet::new();
        let writes: BTreeSet<_> = tree.nodes.iter().flat_map(|it| &it.writes).collect();
        let given = |it: &(usize, String)| it.0 == 0 && self.wishes.given.contains(&it.1);
        for entry in writes.into_iter().filter(|it| !given(it)) {
            let writes = |node: usize| tree.nodes[node].writes.contains(entry);
            let reads = |node: usize| {
                let it = &tree.nodes[node];
                let asks = matches!(it.kind, Kind::Leaf(_) | Kind::Loop { .. });
                asks && it.reads.contains(entry)
            };
            let is_written = |edge: &Edge, asks: Option<usize>| {
                let succeeds = edge.reply == Some(Reply::Leaf(Answer::Success));
                let by_bond = |it: Event| match it {
                    Event::Itself(node, Answer::Success) => {
                        tree.bond(node as usize).is_some() && writes(node as usize)
                    }
                    _ => false,
                };
                succeeds && asks.is_some_and(writes) || self.has(edge, &by_bond)
            };
            let (mut known, mut waiting) = (HashSet::from([0]), VecDeque::from([0]));
            while let Some(at) = waiting.pop_front() {
                let asks = match self.graph.points[at].what {
                    What::Asks(node, how) if node < tree.nodes.len() => Some((node, how)),
                    _ => None,
                };
                if let Some((node, How::Starts | How::Looks)) = asks
                    && reads(node)
                {
                    early.insert((node, entry.1.clone()));
                }
                for edge in &self.graph.points[at].edges {
                    if !is_written(edge, asks.map(|it| it.0)) && known.insert(edge.to) {
                        waiting.push_back(edge.to);
                    }
                }
            }
        }
        early
    }

    /// Returns whether an own property holds.
    pub(super) fn holds(&mut self, property: &Property) -> bool {
        let after = |it: &usize| !matches!(self.graph.points[*it].what, What::Asks(..));
        let holds = |it: &usize, bit: u8| self.graph.points[*it].holds & bit != 0;
        let mut ticked = (1..self.graph.points.len()).filter(after);
        let begins: Vec<usize> = match property {
            Property::Always(_) => return ticked.all(|it| holds(&it, WAITED)),
            Property::Sometime(_) => return ticked.any(|it| holds(&it, WAITED)),
            Property::Finally(_) => vec![0],
            Property::Follows(..) => {
                ticked.filter(|it| holds(it, AFTER) && !holds(it, WAITED)).collect()
            }
        };
        let waits = |it: &usize| !after(it) || !holds(it, WAITED);
        let mut known: HashSet<usize> = begins.iter().copied().collect();
        let mut among = begins;
        let mut at = 0;
        while at < among.len() {
            let point = &self.graph.points[among[at]];
            at += 1;
            if point.what == What::End {
                return false;
            }
            for edge in &point.edges {
                if waits(&edge.to) && known.insert(edge.to) {
                    among.push(edge.to);
                }
            }
        }
        let circles = self.graph.circles(&among, &|it| known.contains(&it.to));
        let keep = |it: &Edge| known.contains(&it.to);
        !circles.iter().any(|it| self.is_fair(it, &keep, &|_| true))
    }
}
