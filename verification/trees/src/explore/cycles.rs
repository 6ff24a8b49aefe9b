//! Runs that never end, and which of them are fair.
//!
//! A run is fair if every action that runs ends or is halted again and again, and every gate that
//! is asked again and again opens again and again; somebody who is asked chooses at last, pauses no
//! tree for ever anew, and queues are empty at last. Conditions are never assumed to be fair.

use super::Space;
use super::graph::What;
use crate::machine::{Event, How, Reply};
use crate::supervisor::Part;
use crate::tree::{Answer, Kind};
use std::collections::{BTreeSet, VecDeque};

/// Points that can be walked through for ever.
#[derive(Clone, Debug, Default)]
pub(crate) struct Circle {
    pub(crate) points: Vec<u32>,
    /// Edges between them that are kept, with their sources.
    pub(crate) edges: Vec<(u32, u32)>,
    /// Edges that a fair walk takes.
    pub(crate) needed: Vec<(u32, u32)>,
}

/// Marks of points, used again and again.
#[derive(Default)]
pub(crate) struct Marks {
    turn: u32,
    member: Vec<u32>,
    index: Vec<u32>,
    low: Vec<u32>,
    open: Vec<bool>,
}

impl Marks {
    pub(crate) fn new(points: usize) -> Marks {
        Marks {
            turn: 0,
            member: vec![0; points],
            index: vec![0; points],
            low: vec![0; points],
            open: vec![false; points],
        }
    }

    fn mark(&mut self, points: &[u32]) -> u32 {
        self.turn += 1;
        points.iter().for_each(|it| self.member[*it as usize] = self.turn);
        self.turn
    }
}

/// Which edges are kept.
type Keep<'k> = &'k dyn Fn(&Space, usize) -> bool;

impl Space<'_> {
    /// Returns the strongly connected components with at least one edge, of the graph restricted to
    /// points and kept edges (Tarjan).
    pub(crate) fn components(&self, points: &[u32], keep: Keep, marks: &mut Marks) -> Vec<Circle> {
        let turn = marks.mark(points);
        points.iter().for_each(|it| marks.index[*it as usize] = u32::MAX);
        let (mut stack, mut found, mut counter) = (Vec::new(), Vec::new(), 0);
        let mut work: Vec<(u32, usize)> = Vec::new();
        for &root in points {
            if marks.index[root as usize] != u32::MAX {
                continue;
            }
            work.push((root, self.out(root as usize).start));
            while let Some((point, next)) = work.last_mut() {
                let at = *point as usize;
                let range = self.out(at);
                if *next == range.start && marks.index[at] == u32::MAX {
                    (marks.index[at], marks.low[at]) = (counter, counter);
                    counter += 1;
                    stack.push(at as u32);
                    marks.open[at] = true;
                }
                if *next < range.end {
                    let edge = *next;
                    *next += 1;
                    let target = self.edges[edge].target as usize;
                    if marks.member[target] != turn || !keep(self, edge) {
                        continue;
                    }
                    if marks.index[target] == u32::MAX {
                        work.push((target as u32, self.out(target).start));
                    } else if marks.open[target] {
                        marks.low[at] = marks.low[at].min(marks.index[target]);
                    }
                    continue;
                }
                work.pop();
                if let Some((parent, _)) = work.last() {
                    let parent = *parent as usize;
                    marks.low[parent] = marks.low[parent].min(marks.low[at]);
                }
                if marks.low[at] == marks.index[at] {
                    // Most points are alone, and not worth a list.
                    if stack.last() == Some(&(at as u32)) && !self.circles_alone(at, keep) {
                        stack.pop();
                        marks.open[at] = false;
                        continue;
                    }
                    let from = stack.iter().rposition(|it| *it == at as u32).unwrap_or(0);
                    let points = stack.split_off(from);
                    points.iter().for_each(|it| marks.open[*it as usize] = false);
                    found.push(points);
                }
            }
        }
        let supervised = self.tree.bonds.is_some();
        let whole = found.into_iter().map(|it| self.circle(it, keep, marks));
        // A supervisor may not move for ever before one tick.
        let ticks =
            |it: &Circle| it.points.iter().any(|at| !supervised || self.is_state(*at as usize));
        whole.filter(|it| !it.edges.is_empty() && ticks(it)).collect()
    }

    /// Returns whether an edge leads from a point to itself.
    fn circles_alone(&self, point: usize, keep: Keep) -> bool {
        self.out(point).any(|it| self.edges[it].target as usize == point && keep(self, it))
    }

    fn circle(&self, points: Vec<u32>, keep: Keep, marks: &mut Marks) -> Circle {
        let turn = marks.mark(&points);
        let mut edges = Vec::new();
        for &point in &points {
            for edge in self.out(point as usize) {
                let target = self.edges[edge].target as usize;
                if marks.member[target] == turn && keep(self, edge) {
                    edges.push((point, edge as u32));
                }
            }
        }
        Circle { points, edges, needed: Vec::new() }
    }

    /// Returns where a fair run can stay for ever, if it also takes an edge that is needed.
    pub(crate) fn fair(
        &mut self,
        circle: &Circle,
        keep: Keep,
        need: Option<Keep>,
        marks: &mut Marks,
    ) -> Option<Circle> {
        let (mut asked, mut opened) = (BTreeSet::new(), BTreeSet::new());
        for &(_, edge) in &circle.edges {
            for event in self.events(edge as usize) {
                match *event {
                    Event::Asked(node, How::Looks, it) if self.waits(node, it) => {
                        asked.insert(node)
                    }
                    Event::Asked(node, How::Looks, _) if !self.pauses(node) => opened.insert(node),
                    _ => false,
                };
            }
        }
        let closed: BTreeSet<u32> = asked.difference(&opened).copied().collect();
        if !closed.is_empty() {
            let smaller = |space: &Space, edge: usize| {
                keep(space, edge)
                    && !space.events(edge).iter().any(|it| match *it {
                        Event::Asked(node, How::Looks, it) => {
                            space.waits(node, it) && closed.contains(&node)
                        }
                        _ => false,
                    })
            };
            let parts = self.components(&circle.points, &smaller, marks);
            return parts.iter().find_map(|it| self.fair(it, &smaller, need, marks));
        }
        let mut needed = Vec::new();
        for node in self.always(circle) {
            let moves = |it: &Event| match *it {
                Event::Asked(at, How::Starts, _)
                | Event::Halted(at)
                | Event::Offered(at, Part::Starts, _) => at as usize == node,
                Event::Itself(at, answer) => at as usize == node && answer != Answer::Running,
                Event::Asked(at, How::Goes, reply) => {
                    at as usize == node && reply != Reply::Leaf(Answer::Running)
                }
                _ => false,
            };
            let moves = |edge: usize| self.events(edge).iter().any(moves);
            match circle.edges.iter().find(|it| moves(it.1 as usize)) {
                Some(edge) => needed.push(*edge),
                // What the supervisor never lets end is not assumed to.
                None if self.tree.bond(node).is_some() && !self.may(circle, &moves) => {}
                None => return None,
            }
        }
        if let Some(need) = need {
            needed.push(*circle.edges.iter().find(|it| need(self, it.1 as usize))?);
        }
        Some(Circle { needed, ..circle.clone() })
    }

    /// Returns whether a reply is not given for ever: a gate stays closed, a queue has one more
    /// item, somebody who is to choose says RUNNING.
    fn waits(&self, node: u32, reply: Reply) -> bool {
        reply
            == match self.tree.nodes.get(node as usize).map(|it| &it.kind) {
                Some(Kind::Loop { .. }) => Reply::Yes,
                Some(Kind::ManualSelector { .. }) => Reply::Leaf(Answer::Running),
                _ => Reply::No,
            }
    }

    /// Returns whether a node can be paused, which does not happen again and again without an end.
    fn pauses(&self, node: u32) -> bool {
        let kind = self.tree.nodes.get(node as usize).map(|it| &it.kind);
        kind == Some(&Kind::PauseResumeController)
    }

    /// Returns whether something can happen on a way from a circle on.
    fn may(&self, circle: &Circle, happens: &dyn Fn(usize) -> bool) -> bool {
        let mut known = vec![false; self.len()];
        let mut work = circle.points.clone();
        work.iter().for_each(|it| known[*it as usize] = true);
        while let Some(point) = work.pop() {
            for edge in self.out(point as usize) {
                if happens(edge) {
                    return true;
                }
                let target = self.edges[edge].target;
                if !std::mem::replace(&mut known[target as usize], true) {
                    work.push(target);
                }
            }
        }
        false
    }

    /// Returns the actions that run in all states of a circle.
    fn always(&mut self, circle: &Circle) -> Vec<usize> {
        let mut always: Option<Vec<usize>> = None;
        for &point in &circle.points {
            if !self.is_state(point as usize) {
                continue;
            }
            self.at(point as usize);
            let mut running = self.running();
            always = Some(match always {
                None => running.collect(),
                Some(before) if before.is_empty() => return before,
                Some(before) => {
                    let running: Vec<_> = running.by_ref().collect();
                    before.into_iter().filter(|it| running.contains(it)).collect()
                }
            });
        }
        always.unwrap_or_default()
    }

    /// Returns a walk around a circle that takes all needed edges, from one of its states on.
    pub(crate) fn walk(&self, circle: &Circle) -> Vec<usize> {
        let states = circle.points.iter().copied().filter(|it| self.is_state(*it as usize));
        let Some(start) = states.min_by_key(|it| self.level[*it as usize]) else {
            return Vec::new();
        };
        let mut needed = circle.needed.clone();
        for _ in 0..=self.tree.nodes.len() {
            let mut path: Vec<usize> = Vec::new();
            let mut at = start;
            for &(source, edge) in &needed {
                path.extend(self.way(circle, at, source));
                path.push(edge as usize);
                at = self.edges[edge as usize].target;
            }
            if path.is_empty() {
                let first = circle.edges.iter().find(|it| it.0 == start);
                let Some(&(_, edge)) = first else { return path };
                path.push(edge as usize);
                at = self.edges[edge as usize].target;
            }
            path.extend(self.way(circle, at, start));
            // A gate that says no on the way must open too.
            let looks = |waits| {
                let events = path.iter().flat_map(|it| self.events(*it));
                let nodes = events.filter_map(move |it| match *it {
                    Event::Asked(node, How::Looks, it) if self.waits(node, it) == waits => {
                        Some(node)
                    }
                    _ => None,
                });
                nodes.collect::<BTreeSet<_>>()
            };
            let closed = looks(true).difference(&looks(false)).copied().next();
            let opens = closed.and_then(|node| {
                let opens = |it: &Event| match *it {
                    Event::Asked(at, How::Looks, it) => at == node && !self.waits(node, it),
                    _ => false,
                };
                circle.edges.iter().find(|it| self.events(it.1 as usize).iter().any(opens))
            });
            match opens {
                Some(&edge) => needed.push(edge),
                None => return path,
            }
        }
        Vec::new()
    }

    /// Returns a shortest way within a circle.
    fn way(&self, circle: &Circle, from: u32, to: u32) -> Vec<usize> {
        if from == to {
            return Vec::new();
        }
        let mut out: std::collections::BTreeMap<u32, Vec<u32>> = std::collections::BTreeMap::new();
        for &(source, edge) in &circle.edges {
            out.entry(source).or_default().push(edge);
        }
        let mut via: std::collections::BTreeMap<u32, (u32, u32)> =
            std::collections::BTreeMap::new();
        let mut waiting = VecDeque::from([from]);
        while let Some(point) = waiting.pop_front() {
            for &edge in out.get(&point).into_iter().flatten() {
                let target = self.edges[edge as usize].target;
                if target == from || via.contains_key(&target) {
                    continue;
                }
                via.insert(target, (point, edge));
                if target == to {
                    waiting.clear();
                    break;
                }
                waiting.push_back(target);
            }
        }
        let (mut path, mut at) = (Vec::new(), to);
        while at != from {
            let Some(&(before, edge)) = via.get(&at) else { return Vec::new() };
            path.push(edge as usize);
            at = before;
        }
        path.reverse();
        path
    }

    /// Returns whether each point can reach an end.
    pub(crate) fn can_end(&self) -> Vec<bool> {
        let mut before: Vec<u32> = vec![0; self.len() + 1];
        for point in 0..self.len() {
            for edge in self.out(point) {
                before[self.edges[edge].target as usize + 1] += 1;
            }
        }
        for at in 1..before.len() {
            before[at] += before[at - 1];
        }
        let mut place = before.clone();
        let mut sources = vec![0_u32; self.edges.len()];
        for point in 0..self.len() {
            for edge in self.out(point) {
                let target = self.edges[edge].target as usize;
                sources[place[target] as usize] = point as u32;
                place[target] += 1;
            }
        }
        let mut can = vec![false; self.len()];
        let ends = (0..self.len()).filter(|it| matches!(self.what(*it), What::End(_)));
        let mut work: Vec<usize> = ends.collect();
        work.iter().for_each(|it| can[*it] = true);
        while let Some(point) = work.pop() {
            for at in before[point]..before[point + 1] {
                let source = sources[at as usize] as usize;
                if !can[source] {
                    can[source] = true;
                    work.push(source);
                }
            }
        }
        can
    }
}
