//! The graph of a plain walk: whole machines as bytes, edges as they were taken.

use super::Within;
use crate::machine::{Event, How, Reply};
use std::collections::HashMap;
use std::rc::Rc;

/// Point of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum What {
    /// Between two ticks.
    State,
    /// Within a tick: who asks, and how.
    Asks(usize, How),
    End,
}

/// An edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) to: usize,
    pub(super) reply: Option<Reply>,
    /// Number of what happened.
    pub(super) events: usize,
    /// The tick ends with a wake-up.
    pub(super) wakes: bool,
}

/// A point with its edges.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) what: What,
    /// Conditions that hold there, as bits.
    pub(super) holds: u8,
    /// Ticks that were over, at least.
    pub(super) ticks: u32,
    pub(super) edges: Vec<Edge>,
    bytes: Rc<[u8]>,
}

/// All points.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    pub(super) points: Vec<Point>,
    numbers: HashMap<Rc<[u8]>, usize>,
    events: Vec<Vec<Event>>,
    lists: HashMap<Vec<Event>, usize>,
}

/// Writes a number, seven bits a byte.
fn write(out: &mut Vec<u8>, mut number: u32) {
    while number > 0x7f {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
}

fn read(bytes: &mut impl Iterator<Item = u8>) -> u32 {
    let (mut number, mut shift) = (0, 0);
    for byte in bytes {
        number |= ((byte & 0x7f) as u32) << shift;
        shift += 7;
        if byte < 0x80 {
            break;
        }
    }
    number
}

impl Graph {
    /// Returns the number of a point, and whether it is new.
    pub(super) fn add(
        &mut self,
        what: What,
        ((cells, entries), at, wake): &Within,
        holds: u8,
        ticks: u32,
    ) -> (usize, bool) {
        let mut bytes = Vec::with_capacity(cells.len() + entries.len() + 4);
        write(&mut bytes, at.map_or(0, |it| it as u32 + 1) << 1 | *wake as u32);
        write(&mut bytes, cells.len() as u32);
        cells.iter().chain(entries).for_each(|it| write(&mut bytes, *it));
        if let Some(&known) = self.numbers.get(bytes.as_slice()) {
            return (known, false);
        }
        let (bytes, number): (Rc<[u8]>, _) = (bytes.into(), self.points.len());
        self.numbers.insert(bytes.clone(), number);
        self.points.push(Point { what, holds, ticks, edges: Vec::new(), bytes });
        (number, true)
    }

    /// Returns the machine at a point.
    pub(super) fn within(&self, point: usize) -> Within {
        let mut bytes = self.points[point].bytes.iter().copied().peekable();
        let head = read(&mut bytes);
        let count = read(&mut bytes) as usize;
        let mut all = Vec::new();
        while bytes.peek().is_some() {
            all.push(read(&mut bytes));
        }
        let entries = all.split_off(count);
        ((all, entries), (head >> 1).checked_sub(1).map(|it| it as usize), head & 1 == 1)
    }

    /// Returns the number of a list of events.
    pub(super) fn list(&mut self, events: &[Event]) -> usize {
        if let Some(&known) = self.lists.get(events) {
            return known;
        }
        self.lists.insert(events.to_vec(), self.events.len());
        self.events.push(events.to_vec());
        self.events.len() - 1
    }

    /// Returns what happened at an edge.
    pub(super) fn events(&self, edge: &Edge) -> &[Event] {
        &self.events[edge.events]
    }

    /// Returns the points from which each point can be reached in one step.
    fn before(&self) -> Vec<Vec<usize>> {
        let mut before = vec![Vec::new(); self.points.len()];
        for (from, point) in self.points.iter().enumerate() {
            point.edges.iter().for_each(|it| before[it.to].push(from));
        }
        before
    }

    /// Returns whether each point can reach an end.
    pub(super) fn can_end(&self) -> Vec<bool> {
        let before = self.before();
        let mut can: Vec<_> = self.points.iter().map(|it| it.what == What::End).collect();
        let mut work: Vec<_> = (0..can.len()).filter(|it| can[*it]).collect();
        while let Some(at) = work.pop() {
            for &from in &before[at] {
                if !std::mem::replace(&mut can[from], true) {
                    work.push(from);
                }
            }
        }
        can
    }

    /// Returns the sets of points, among some, of which each reaches each by kept edges, at least
    /// one (Kosaraju): first the order in which searches are done with points, then searches
    /// backwards in that order.
    pub(super) fn circles(&self, among: &[usize], keep: &dyn Fn(&Edge) -> bool) -> Vec<Vec<usize>> {
        let mut is_among = vec![false; self.points.len()];
        among.iter().for_each(|it| is_among[*it] = true);
        let mut before: HashMap<usize, Vec<usize>> = HashMap::new();
        for &from in among {
            let kept = self.points[from].edges.iter().filter(|it| is_among[it.to] && keep(it));
            kept.for_each(|it| before.entry(it.to).or_default().push(from));
        }
        let (mut known, mut order) = (vec![false; self.points.len()], Vec::new());
        for &root in among {
            let mut path = vec![(root, 0)];
            while let Some((at, next)) = path.pop() {
                if next == 0 && std::mem::replace(&mut known[at], true) {
                    continue;
                }
                match self.points[at].edges.get(next) {
                    None => order.push(at),
                    Some(edge) => {
                        path.push((at, next + 1));
                        if is_among[edge.to] && keep(edge) && !known[edge.to] {
                            path.push((edge.to, 0));
                        }
                    }
                }
            }
        }
        let mut circles = Vec::new();
        for &root in order.iter().rev() {
            let (mut circle, mut work) = (Vec::new(), vec![root]);
            while let Some(at) = work.pop() {
                if std::mem::replace(&mut known[at], false) {
                    circle.push(at);
                    work.extend(before.get(&at).into_iter().flatten());
                }
            }
            let alone = |at: usize| self.points[at].edges.iter().any(|it| it.to == at && keep(it));
            if circle.len() > 1 || circle.iter().any(|it| alone(*it)) {
                circles.push(circle);
            }
        }
        circles
    }
}
