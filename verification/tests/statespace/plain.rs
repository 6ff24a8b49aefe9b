//! A search as in a textbook, to compare with: markings as vectors in a set, level by level.

use cotama_verification::pt::Pt;
use std::collections::HashMap;

/// The result of the plain search.
pub(crate) struct Plain {
    /// Markings in the order in which they were met, those of complete levels only.
    pub(crate) markings: Vec<Vec<u32>>,
    /// For each marking how many firings it is away.
    pub(crate) depths: Vec<u64>,
    /// For each marking its enabled transitions, and where each leads if that is known.
    pub(crate) arcs: Vec<Vec<(u32, Option<usize>)>>,
    /// Whether these are all.
    pub(crate) is_complete: bool,
}

/// All markings of those levels that have together at most so many.
pub(crate) fn plain(pt: &Pt, most: usize) -> Plain {
    let mut markings = vec![pt.initial.clone()];
    let mut depths = vec![0];
    let mut numbers = HashMap::from([(pt.initial.clone(), 0)]);
    let mut arcs: Vec<Vec<(u32, Option<usize>)>> = Vec::new();
    let mut level = 0..1;
    while !level.is_empty() {
        for from in level.clone() {
            let enabled =
                (0..pt.transitions.len() as u32).filter(|it| pt.enabled(&markings[from], *it));
            let mut out = Vec::new();
            for transition in enabled.collect::<Vec<_>>() {
                let after = pt.fire(&markings[from], transition).unwrap();
                let next = markings.len();
                let number = *numbers.entry(after.clone()).or_insert(next);
                if number == next {
                    markings.push(after);
                    depths.push(depths[from] + 1);
                }
                out.push((transition, Some(number)));
            }
            arcs.push(out);
        }
        if markings.len() > most {
            markings.truncate(level.end);
            depths.truncate(level.end);
            for arc in arcs.iter_mut().flatten() {
                arc.1 = arc.1.filter(|it| *it < level.end);
            }
            return Plain { markings, depths, arcs, is_complete: false };
        }
        level = level.end..markings.len();
    }
    Plain { markings, depths, arcs, is_complete: true }
}

impl Plain {
    /// The most tokens of each place.
    pub(crate) fn bounds(&self) -> Vec<u64> {
        let places = 0..self.markings[0].len();
        places
            .map(|place| self.markings.iter().map(|it| u64::from(it[place])).max().unwrap())
            .collect()
    }

    /// For each marking those that can be reached from it, in a search from each.
    pub(crate) fn reachable(&self) -> Vec<Vec<bool>> {
        let from = |start: usize| {
            let mut met = vec![false; self.markings.len()];
            let mut open = vec![start];
            met[start] = true;
            while let Some(state) = open.pop() {
                for to in self.arcs[state].iter().filter_map(|it| it.1) {
                    if !std::mem::replace(&mut met[to], true) {
                        open.push(to);
                    }
                }
            }
            met
        };
        (0..self.markings.len()).map(from).collect()
    }
}
