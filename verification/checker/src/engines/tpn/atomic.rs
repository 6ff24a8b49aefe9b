//! State classes in which all states go on in the same way.
//!
//! A strong class is a marking with the values of clocks that its states have just after a firing;
//! it is atomic when each of its states leads, by each firing, to a state of each class that the
//! class leads to. So all states of an atomic class satisfy the same formulas of CTL (T. Yoneda and
//! H. Ryuba 1998; B. Berthomieu and F. Vernadat, *State class constructions for branching analysis
//! of time Petri nets*, TACAS 2003). Classes are split until they are atomic. A clock without a
//! latest time shows nothing more once the earliest one has come, so classes are finitely many.

use super::bound::Bound;
use super::classes::ClassId;
use super::graph::ClassGraph;
use super::markings::{Markings, Rules, Step};
use super::zone::Zone;
use super::{Limit, Limits};
use cotama_core::net::TransitionId;
use cotama_property::time::TimeNet;
use std::collections::{HashMap, VecDeque};

/// The graph of the atomic classes of a net: the states are those just after a firing, and at the
/// start.
///
/// # Errors
/// Why it is not complete, and how many classes there were.
pub(crate) fn atomic(net: &TimeNet, limits: &Limits) -> Result<ClassGraph, (Limit, usize)> {
    let mut classes = Atomic::new(net);
    let made = classes.explore(limits).and_then(|()| classes.split_all(limits));
    made.map_err(|limit| (limit, classes.list.len()))?;
    Ok(classes.graph())
}

/// A firing of the transition at this position among the enabled ones, to this class.
type Edge = (u32, ClassId);

struct Atomic {
    rules: Rules,
    markings: Markings,
    list: Vec<(u32, Zone)>,
    edges: Vec<Vec<Edge>>,
    /// Classes that lead to each class, some of them no more.
    before: Vec<Vec<ClassId>>,
    bytes: usize,
    steps: u32,
}

impl Atomic {
    fn new(net: &TimeNet) -> Self {
        let rules = Rules::new(net);
        Self {
            markings: Markings::new(&rules),
            rules,
            list: Vec::new(),
            edges: Vec::new(),
            before: Vec::new(),
            bytes: 0,
            steps: 0,
        }
    }

    fn check(&mut self, limits: &Limits) -> Result<(), Limit> {
        self.steps = self.steps.wrapping_add(1);
        if self.list.len() as u64 > limits.states {
            return Err(Limit::States);
        }
        limits.check(self.steps, || self.bytes + self.markings.bytes())
    }

    fn push(&mut self, marking: u32, zone: Zone) -> ClassId {
        // Lists grow twofold; a piece of the heap has 16 bytes more.
        let lists = size_of::<(u32, Zone)>() + 2 * size_of::<Vec<Edge>>();
        self.bytes += zone.bytes() + 2 * lists + 4 * size_of::<Edge>() + 3 * 16;
        self.list.push((marking, zone));
        self.edges.push(Vec::new());
        self.before.push(Vec::new());
        self.list.len() as ClassId - 1
    }

    /// The values that a firing of an enabled transition can find, when it comes; and then those
    /// of clocks that are enabled after it.
    fn after(&self, class: ClassId, position: usize, step: Step) -> Vec<Zone> {
        let (marking, zone) = &self.list[class as usize];
        let enabled = self.markings.enabled(*marking);
        let lower = self.rules.intervals[enabled[position] as usize].0;
        let due = self.forced(zone.clone().later(), *marking);
        let Some(due) = due.and_then(|it| it.at_least(position + 1, lower)) else {
            return Vec::new();
        };
        self.parted(due.fired(self.markings.kept(step)), step.target)
    }

    /// No transition waits longer than it may.
    fn forced(&self, zone: Zone, marking: u32) -> Option<Zone> {
        let uppers =
            self.markings.enabled(marking).iter().map(|it| &self.rules.intervals[*it as usize]);
        (1..).zip(uppers).try_fold(zone, |zone, (clock, it)| zone.at_most(clock, it.1))
    }

    /// Clocks without a latest time show less than the earliest time, or nothing.
    fn parted(&self, zone: Zone, marking: u32) -> Vec<Zone> {
        let mut parts = vec![zone];
        for (clock, transition) in (1..).zip(self.markings.enabled(marking)) {
            let (lower, upper) = self.rules.intervals[*transition as usize];
            if upper == Bound::INFINITE {
                let halves = |it: Zone| {
                    let waits = it.clone().at_most(clock, lower.beyond());
                    let beyond = it.at_least(clock, lower).and_then(|it| it.beyond(clock, lower));
                    waits.into_iter().chain(beyond)
                };
                parts = parts.into_iter().flat_map(halves).collect();
            }
        }
        parts
    }

    /// Strong classes; one that lies in another one is not kept.
    fn explore(&mut self, limits: &Limits) -> Result<(), Limit> {
        let start = Zone::zero(self.markings.enabled(0).len());
        for zone in self.parted(start, 0) {
            self.push(0, zone);
        }
        let mut of: HashMap<u32, Vec<ClassId>> = HashMap::from([(0, vec![0])]);
        let mut class = 0;
        while (class as usize) < self.list.len() {
            self.check(limits)?;
            let marking = self.list[class as usize].0;
            for position in 0..self.markings.enabled(marking).len() {
                let step = self.step(marking, position)?;
                for zone in self.after(class, position, step) {
                    let same = of.entry(step.target).or_default();
                    let known =
                        same.iter().copied().find(|it| self.list[*it as usize].1.contains(&zone));
                    let target = known.unwrap_or(self.list.len() as ClassId);
                    if known.is_none() {
                        same.push(target);
                        self.push(step.target, zone);
                    }
                    self.connect(class, position as u32, target);
                }
            }
            class += 1;
        }
        Ok(())
    }

    fn step(&mut self, marking: u32, position: usize) -> Result<Step, Limit> {
        self.markings.step(&self.rules, marking, position).ok_or(Limit::Tokens)
    }

    fn connect(&mut self, from: ClassId, position: u32, to: ClassId) {
        if !self.edges[from as usize].contains(&(position, to)) {
            self.edges[from as usize].push((position, to));
            self.before[to as usize].push(from);
            self.bytes += 2 * size_of::<Edge>();
        }
    }

    /// The states of a class from which this firing leads to some state of another class.
    fn leading(&mut self, from: ClassId, (position, to): Edge) -> Result<Option<Zone>, Limit> {
        let marking = self.list[from as usize].0;
        let step = self.step(marking, position as usize)?;
        let enabled = self.markings.enabled(marking);
        let lower = self.rules.intervals[enabled[position as usize] as usize].0;
        let before = self.list[to as usize].1.before(self.markings.kept(step), enabled.len());
        let due = before
            .and_then(|it| self.forced(it, marking))
            .and_then(|it| it.at_least(position as usize + 1, lower));
        Ok(due.and_then(|it| it.earlier().and(&self.list[from as usize].1)))
    }

    /// Splits classes until all are atomic.
    fn split_all(&mut self, limits: &Limits) -> Result<(), Limit> {
        let mut open: VecDeque<ClassId> = (0..self.list.len() as ClassId).collect();
        let mut is_open = vec![true; self.list.len()];
        while let Some(class) = open.pop_front() {
            is_open[class as usize] = false;
            for edge in self.edges[class as usize].clone() {
                self.check(limits)?;
                let part = self.leading(class, edge)?;
                let Some(part) = part.filter(|it| !it.contains(&self.list[class as usize].1))
                else {
                    continue;
                };
                for changed in self.split(class, part)? {
                    is_open.resize(self.list.len(), false);
                    if !std::mem::replace(&mut is_open[changed as usize], true) {
                        open.push_back(changed);
                    }
                }
                break;
            }
        }
        Ok(())
    }

    /// Splits a class into a part of it and the rest; the classes that are to be looked at again.
    fn split(&mut self, class: ClassId, part: Zone) -> Result<Vec<ClassId>, Limit> {
        let (marking, whole) = self.list[class as usize].clone();
        let mut parts = vec![class];
        for zone in whole.without(&part) {
            parts.push(self.push(marking, zone));
        }
        self.list[class as usize].1 = part;
        let edges = std::mem::take(&mut self.edges[class as usize]);
        let mut changed = parts.clone();
        let mut sources = std::mem::take(&mut self.before[class as usize]);
        sources.retain(|it| *it != class);
        sources.sort_unstable();
        sources.dedup();
        for &from in &parts {
            for &(position, to) in &edges {
                let targets = if to == class { &parts[..] } else { &[to] };
                for &to in targets {
                    if self.leading(from, (position, to))?.is_some() {
                        self.connect(from, position, to);
                    }
                }
            }
        }
        for from in sources {
            let (ours, others): (Vec<Edge>, Vec<Edge>) =
                self.edges[from as usize].iter().partition(|it| it.1 == class);
            if ours.is_empty() {
                continue;
            }
            self.edges[from as usize] = others;
            for (position, _) in ours {
                for &to in &parts {
                    if self.leading(from, (position, to))?.is_some() {
                        self.connect(from, position, to);
                    }
                }
            }
            changed.push(from);
        }
        Ok(changed)
    }

    fn graph(self) -> ClassGraph {
        let Self { rules, markings, list, edges, .. } = self;
        let fired = |class: usize, (position, to): Edge| {
            (TransitionId(markings.enabled(list[class].0)[position as usize]), to)
        };
        let edges = edges.into_iter().enumerate().map(|(class, edges)| {
            let mut edges: Vec<_> = edges.into_iter().map(|it| fired(class, it)).collect();
            edges.sort_unstable();
            edges
        });
        let edges: Vec<_> = edges.collect();
        let marking_of = list.iter().map(|it| it.0).collect();
        ClassGraph::new(rules.pt, &markings, marking_of, edges.iter().map(Vec::as_slice))
    }
}
