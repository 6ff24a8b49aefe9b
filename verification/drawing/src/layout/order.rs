//! The order in each layer: few crossings.

use super::{Layered, OPTIMISED};

/// Passes over all layers without a better result after which the search ends.
const PATIENCE: usize = 6;

/// Rounds of exchanging neighbours in a pass.
const EXCHANGES: usize = 8;

/// Puts the vertices into their layers and orders them.
pub(super) fn reduce_crossings(it: &mut Layered) {
    let small = it.kinds.len() <= OPTIMISED;
    let mut best: Option<(usize, Vec<Vec<usize>>)> = None;
    for downwards_first in [true, false] {
        it.layers = initial(it, downwards_first);
        let mut position = positions(it);
        let mut failures = 0;
        for pass in 0.. {
            let crossings = crossings(it, &position);
            if best.as_ref().is_none_or(|(fewest, _)| crossings < *fewest) {
                best = Some((crossings, it.layers.clone()));
                failures = 0;
            } else {
                failures += 1;
            }
            if crossings == 0 || failures > PATIENCE || (!small && pass == 2) {
                break;
            }
            sweep(it, &mut position, (pass % 2 == 0) == downwards_first);
            if small {
                exchange(it, &mut position);
            }
        }
        if !small {
            break;
        }
    }
    it.layers = best.map(|(_, layers)| layers).unwrap_or_default();
}

/// In the order in which a depth-first search from one side meets them.
fn initial(it: &Layered, downwards: bool) -> Vec<Vec<usize>> {
    let mut layers = vec![Vec::new(); it.layer.iter().max().map_or(0, |last| last + 1)];
    let mut seen = vec![false; it.kinds.len()];
    let mut starts: Vec<usize> = (0..it.kinds.len()).collect();
    starts.sort_by_key(
        |&vertex| if downwards { it.layer[vertex] } else { usize::MAX - it.layer[vertex] },
    );
    for start in starts {
        let mut open = vec![start];
        while let Some(vertex) = open.pop() {
            if std::mem::replace(&mut seen[vertex], true) {
                continue;
            }
            layers[it.layer[vertex]].push(vertex);
            open.extend(
                it.below[vertex].iter().chain(&it.above[vertex]).rev().filter(|&&to| !seen[to]),
            );
        }
    }
    layers
}

fn positions(it: &Layered) -> Vec<usize> {
    let mut position = vec![0; it.kinds.len()];
    for layer in &it.layers {
        renumber(layer, &mut position);
    }
    position
}

fn renumber(layer: &[usize], position: &mut [usize]) {
    for (at, &vertex) in layer.iter().enumerate() {
        position[vertex] = at;
    }
}

/// Sorts every layer by the mean position of the neighbours in the layer before it.
fn sweep(it: &mut Layered, position: &mut [usize], downwards: bool) {
    let count = it.layers.len();
    let neighbours = if downwards { &it.above } else { &it.below };
    for step in 1..count {
        let layer = &mut it.layers[if downwards { step } else { count - 1 - step }];
        let mean = |&vertex: &usize| {
            let around = &neighbours[vertex];
            let sum: usize = around.iter().map(|&to| position[to]).sum();
            // Without neighbours a vertex stays about where it is; 1024ths tell close means apart.
            (sum * 1024).checked_div(around.len()).unwrap_or(position[vertex] * 1024)
        };
        layer.sort_by_cached_key(mean);
        renumber(layer, position);
    }
}

/// Exchanges neighbours as long as that removes crossings.
fn exchange(it: &mut Layered, position: &mut [usize]) {
    for _ in 0..EXCHANGES {
        let mut improved = false;
        for layer in &mut it.layers {
            for at in 1..layer.len() {
                let (one, other) = (layer[at - 1], layer[at]);
                let (mut now, mut then) = (0, 0);
                for neighbours in [&it.above, &it.below] {
                    for &from_one in &neighbours[one] {
                        for &from_other in &neighbours[other] {
                            now += usize::from(position[from_one] > position[from_other]);
                            then += usize::from(position[from_one] < position[from_other]);
                        }
                    }
                }
                if then < now {
                    layer.swap(at - 1, at);
                    position.swap(one, other);
                    improved = true;
                }
            }
        }
        if !improved {
            break;
        }
    }
}

/// How many pairs of lines cross.
fn crossings(it: &Layered, position: &[usize]) -> usize {
    let count = |layer: &Vec<usize>| {
        let mut ends = Vec::new();
        for &vertex in layer {
            let first = ends.len();
            ends.extend(it.below[vertex].iter().map(|&to| position[to]));
            ends[first..].sort_unstable();
        }
        inversions(&ends)
    };
    it.layers.iter().map(count).sum()
}

/// Pairs in the wrong order, by a tree of counts (Fenwick, 1994).
fn inversions(values: &[usize]) -> usize {
    let size = values.iter().max().map_or(0, |last| last + 1);
    let mut tree = vec![0; size + 1];
    let mut inversions = 0;
    for (before, &value) in values.iter().enumerate() {
        let (mut at, mut not_after) = (value + 1, 0);
        while at > 0 {
            not_after += tree[at];
            at &= at - 1;
        }
        inversions += before - not_after;
        at = value + 1;
        while at <= size {
            tree[at] += 1;
            at += at & at.wrapping_neg();
        }
    }
    inversions
}

#[cfg(test)]
mod tests {
    use super::inversions;

    #[test]
    fn inversions_are_the_pairs_in_the_wrong_order() {
        assert_eq!(inversions(&[]), 0);
        assert_eq!(inversions(&[0, 1, 1, 2]), 0);
        assert_eq!(inversions(&[2, 1, 0]), 3);
        assert_eq!(inversions(&[1, 0, 3, 2, 0]), 5);
    }
}
