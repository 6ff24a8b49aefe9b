//! Searches that climb: K2 along an order, and hill climbing over graphs.

use super::constraints::Constraints;
use super::score::Families;
use crate::dag::{Dag, bits};
use cotama_streams::{Stream, Streams};

/// A gain smaller than this is rounding.
pub(super) const GAIN: f64 = 1e-9;

/// K2 (Cooper and Herskovits, Mach. Learn. 9, 1992) with the score of the families: along the
/// order, each variable takes from those before it the parent that raises its score most, as long
/// as one does. Optimal for no more than its own steps; a cycle cannot come about.
///
/// The order holds each variable once. A required parent that stands behind its child is left out.
pub fn k2(families: &mut Families<'_>, order: &[usize], constraints: &Constraints) -> Dag {
    let (mut dag, mut before) = (Dag::empty(families.data().variables().len()), 0_u64);
    for &child in order {
        let mut parents = constraints.required()[child] & before;
        let mut score = families.family(child, parents);
        while (parents.count_ones() as usize) < constraints.max_parents() {
            let mut best: Option<(f64, usize)> = None;
            // Ties fall to the one that is earlier in the order.
            let free = before & constraints.allowed()[child] & !parents;
            for &parent in order.iter().filter(|it| free >> **it & 1 == 1) {
                let new = families.family(child, parents | 1 << parent);
                if best.is_none_or(|it| new > it.0 + GAIN) {
                    best = Some((new, parent));
                }
            }
            match best.filter(|it| it.0 > score + GAIN) {
                Some((new, parent)) => (score, parents) = (new, parents | 1 << parent),
                None => break,
            }
        }
        dag.set(child, parents);
        before |= 1 << child;
    }
    dag
}

/// A change of one arc: children and their new parents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Change {
    pub(super) child: usize,
    pub(super) parents: u64,
    /// The other end of an arc that is turned round.
    pub(super) other: Option<(usize, u64)>,
}

impl Change {
    pub(super) fn make(self, dag: &mut Dag) {
        // The arc is taken away before the other one is put in.
        dag.set(self.child, self.parents);
        if let Some((other, parents)) = self.other {
            dag.set(other, parents);
        }
    }

    pub(super) fn gain(self, dag: &Dag, families: &mut Families<'_>) -> f64 {
        let mut of = |child: usize, parents: u64| {
            families.family(child, parents) - families.family(child, dag.parents()[child])
        };
        of(self.child, self.parents) + self.other.map_or(0.0, |it| of(it.0, it.1))
    }
}

/// All graphs that differ by one arc added, removed or turned round, and that meet the constraints.
pub(super) fn neighbours(dag: &Dag, constraints: &Constraints) -> Vec<Change> {
    let (ancestors, parents) = (dag.ancestors(), dag.parents());
    let mut all = Vec::new();
    for to in 0..parents.len() {
        for from in (0..parents.len()).filter(|it| *it != to) {
            let bit = 1 << from;
            if parents[to] & bit == 0 {
                let added = parents[to] | bit;
                if ancestors[from] >> to & 1 == 0 && constraints.allow(to, added) {
                    all.push(Change { child: to, parents: added, other: None });
                }
                continue;
            }
            let less = parents[to] & !bit;
            if !constraints.allow(to, less) {
                continue;
            }
            all.push(Change { child: to, parents: less, other: None });
            let more = parents[from] | 1 << to;
            // Another path from `from` to `to` would become a cycle.
            let has_path = bits(less).any(|it| ancestors[it] >> from & 1 == 1);
            if !has_path && constraints.allow(from, more) {
                all.push(Change { child: to, parents: less, other: Some((from, more)) });
            }
        }
    }
    all
}

/// Hill climbing: from the least graph the best change of one arc, as long as one raises the score;
/// then again from graphs a few random changes away from the best. The same seed gives the same
/// graph; a local optimum, no more.
pub fn hill(
    families: &mut Families<'_>,
    constraints: &Constraints,
    restarts: u64,
    seed: u64,
) -> Dag {
    let streams = Streams::new(seed);
    let mut best = climb(families, constraints, constraints.least());
    let mut score = families.of(&best);
    for restart in 0..restarts {
        let mut stream = streams.stream(&format!("restart {restart}"));
        let start = shaken(best.clone(), constraints, &mut stream);
        let found = climb(families, constraints, start);
        let new = families.of(&found);
        if new > score + GAIN {
            (best, score) = (found, new);
        }
    }
    best
}

fn climb(families: &mut Families<'_>, constraints: &Constraints, mut dag: Dag) -> Dag {
    loop {
        let mut best: Option<(f64, Change)> = None;
        for change in neighbours(&dag, constraints) {
            let gain = change.gain(&dag, families);
            if gain > best.map_or(0.0, |it| it.0) + GAIN {
                best = Some((gain, change));
            }
        }
        match best {
            Some((_, change)) => change.make(&mut dag),
            None => return dag,
        }
    }
}

fn shaken(mut dag: Dag, constraints: &Constraints, stream: &mut Stream) -> Dag {
    for _ in 0..2 + dag.parents().len() / 2 {
        let all = neighbours(&dag, constraints);
        if let Some(change) = all.get(stream.below(all.len() as u64) as usize) {
            change.make(&mut dag);
        }
    }
    dag
}
