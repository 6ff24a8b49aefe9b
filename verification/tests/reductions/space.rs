//! The behaviour of a small net, marking by marking.

use cotama_core::net::TransitionId;
use cotama_verification::pt::Pt;
use std::collections::{BTreeMap, BTreeSet, HashMap};

pub(crate) type Seen = Vec<i64>;

pub(crate) struct Space {
    pub(crate) markings: Vec<Vec<u32>>,
    pub(crate) edges: Vec<Vec<u32>>,
    from: Vec<Option<(u32, u32)>>,
    pub(crate) complete: bool,
}

impl Space {
    pub(crate) fn new(pt: &Pt, most: usize) -> Self {
        let mut ids = HashMap::from([(pt.initial.clone(), 0_u32)]);
        let mut all = Self {
            markings: vec![pt.initial.clone()],
            edges: vec![],
            from: vec![None],
            complete: true,
        };
        while all.edges.len() < all.markings.len() {
            let at = all.edges.len();
            let marking = all.markings[at].clone();
            let mut edges = Vec::new();
            for transition in 0..pt.transitions.len() as u32 {
                if !pt.enabled(&marking, transition) {
                    continue;
                }
                let after = pt.fire(&marking, transition).unwrap();
                let next = match ids.get(&after) {
                    Some(&id) => id,
                    None if all.markings.len() == most => {
                        all.complete = false;
                        return all;
                    }
                    None => {
                        ids.insert(after.clone(), all.markings.len() as u32);
                        all.markings.push(after);
                        all.from.push(Some((at as u32, transition)));
                        all.markings.len() as u32 - 1
                    }
                };
                edges.push(next);
            }
            all.edges.push(edges);
        }
        all
    }

    pub(crate) fn path(&self, mut to: usize) -> Vec<TransitionId> {
        let mut way = Vec::new();
        while let Some((from, transition)) = self.from[to] {
            way.push(TransitionId(transition));
            to = from as usize;
        }
        way.reverse();
        way
    }

    pub(crate) fn dead(&self) -> impl Iterator<Item = usize> {
        (0..self.edges.len()).filter(|&it| self.edges[it].is_empty())
    }
}

pub(crate) fn run(pt: &Pt, run: &[TransitionId]) -> Option<Vec<u32>> {
    run.iter().try_fold(pt.initial.clone(), |marking, it| {
        pt.enabled(&marking, it.0).then(|| pt.fire(&marking, it.0).unwrap())
    })
}

pub(crate) fn is_dead(pt: &Pt, marking: &[u32]) -> bool {
    (0..pt.transitions.len() as u32).all(|it| !pt.enabled(marking, it))
}

/// Whether both have the same maximal runs but for repetitions: of what is seen, both sides' by
/// marking.
///
/// Both sides are made deterministic over changes of what is seen. Since they are finite, they have
/// the same infinite runs when they have the same beginnings; the runs that end in the same for
/// ever are compared one by one.
pub(crate) fn same_stutter_runs(a: (&Space, &[Seen]), b: (&Space, &[Seen])) -> bool {
    let start = (closed(a, &[0]), closed(b, &[0]));
    if a.1[0] != b.1[0] {
        return false;
    }
    let (mut known, mut open) = (BTreeSet::from([start.clone()]), vec![start]);
    while let Some((of_a, of_b)) = open.pop() {
        if stays(a, &of_a) != stays(b, &of_b) {
            return false;
        }
        let (to_a, to_b) = (changes(a, &of_a), changes(b, &of_b));
        if !to_a.keys().eq(to_b.keys()) {
            return false;
        }
        for (a_next, b_next) in to_a.into_values().zip(to_b.into_values()) {
            let next = (closed(a, &a_next), closed(b, &b_next));
            if known.insert(next.clone()) {
                open.push(next);
            }
        }
    }
    true
}

/// With what follows without a change.
fn closed((space, seen): (&Space, &[Seen]), from: &[u32]) -> Vec<u32> {
    let (mut all, mut open) = (from.iter().copied().collect::<BTreeSet<_>>(), from.to_vec());
    while let Some(at) = open.pop() {
        for &next in &space.edges[at as usize] {
            if seen[next as usize] == seen[at as usize] && all.insert(next) {
                open.push(next);
            }
        }
    }
    all.into_iter().collect()
}

fn changes((space, seen): (&Space, &[Seen]), from: &[u32]) -> BTreeMap<Seen, Vec<u32>> {
    let mut all: BTreeMap<Seen, Vec<u32>> = BTreeMap::new();
    for &at in from {
        for &next in &space.edges[at as usize] {
            if seen[next as usize] != seen[at as usize] {
                all.entry(seen[next as usize].clone()).or_default().push(next);
            }
        }
    }
    all
}

/// Whether one of these markings, all with the same seen, is dead or on a cycle of them.
fn stays((space, seen): (&Space, &[Seen]), among: &[u32]) -> bool {
    let mut left: BTreeSet<u32> = among.iter().copied().collect();
    loop {
        let goes_on = |&at: &u32| {
            let edges = &space.edges[at as usize];
            edges.is_empty()
                || edges
                    .iter()
                    .any(|it| left.contains(it) && seen[*it as usize] == seen[at as usize])
        };
        let next: BTreeSet<u32> = left.iter().copied().filter(goes_on).collect();
        if next.len() == left.len() {
            return !left.is_empty();
        }
        left = next;
    }
}

/// Whether the two are bisimilar.
pub(crate) fn bisimilar(a: (&Space, &[Seen]), b: (&Space, &[Seen])) -> bool {
    let mut classes: Vec<Vec<usize>> = vec![Vec::new(), Vec::new()];
    let mut count = 0;
    loop {
        let mut ids = BTreeMap::new();
        let mut next = Vec::new();
        for (side, (space, seen)) in [a, b].into_iter().enumerate() {
            let of = |at: usize| {
                let mut to: Vec<usize> = space.edges[at]
                    .iter()
                    .filter_map(|&it| classes[side].get(it as usize).copied())
                    .collect();
                to.sort_unstable();
                to.dedup();
                (seen[at].clone(), space.edges[at].is_empty(), to)
            };
            let mut side_next = Vec::new();
            for at in 0..space.markings.len() {
                let new = ids.len();
                side_next.push(*ids.entry(of(at)).or_insert(new));
            }
            next.push(side_next);
        }
        classes = next;
        if ids.len() == count {
            return classes[0][0] == classes[1][0];
        }
        count = ids.len();
    }
}
