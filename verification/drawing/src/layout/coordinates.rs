//! Horizontal coordinates: long edges straight, nodes over the middle of their neighbours.
//!
//! Brandes and Köpf (2001): vertices are aligned with a median neighbour, towards each of the four
//! corners in turn; the aligned blocks are packed, and each vertex gets the mean of its two middle
//! results. All four results keep the distances, so the mean keeps them too.

use super::{Layered, Vertex};
use std::collections::BTreeSet;

/// By vertex: its x.
pub(super) fn assign(it: &Layered) -> Vec<i64> {
    let conflicts = conflicts(it);
    let corners = [(true, true), (true, false), (false, true), (false, false)];
    let mut results = corners.map(|(downwards, rightwards)| {
        let mut layers: Vec<Vec<usize>> = it.layers.clone();
        if !downwards {
            layers.reverse();
        }
        if !rightwards {
            for layer in &mut layers {
                layer.reverse();
            }
        }
        let neighbours = if downwards { &it.above } else { &it.below };
        let block = align(&layers, &main(it, neighbours), &conflicts);
        let (before, after) =
            if rightwards { (&it.left, &it.right) } else { (&it.right, &it.left) };
        let mut x = pack(&layers, &block, before, after);
        if !rightwards {
            for x in &mut x {
                *x = -*x;
            }
        }
        x
    });
    let span = |x: &Vec<i64>| {
        let least = (0..x.len()).map(|at| x[at] - it.left[at]).min().unwrap_or(0);
        (least, (0..x.len()).map(|at| x[at] + it.right[at]).max().unwrap_or(0))
    };
    let narrowest =
        results.iter().map(span).min_by_key(|(least, most)| most - least).unwrap_or((0, 0));
    for (x, (_, rightwards)) in results.iter_mut().zip(corners) {
        let own = span(x);
        let shift = if rightwards { narrowest.0 - own.0 } else { narrowest.1 - own.1 };
        for x in x {
            *x += shift;
        }
    }
    let middle = |at: usize| {
        let mut four = [results[0][at], results[1][at], results[2][at], results[3][at]];
        four.sort_unstable();
        (four[1] + four[2]).div_euclid(2)
    };
    let mut x = (0..it.kinds.len()).map(middle).collect();
    tighten(it, &mut x);
    x
}

/// Rounds of drawing detours in.
const ROUNDS: usize = 8;

/// Moves what stands farther to one side than all its neighbours, nodes alone and straight pieces
/// of edges as a whole, towards them as far as there is room. The mean of four packings leaves such
/// detours where nothing pulls.
fn tighten(it: &Layered, x: &mut Vec<i64>) {
    let mut room = Room { it, beside: vec![(None, None); x.len()] };
    for pair in it.layers.iter().flat_map(|layer| layer.windows(2)) {
        room.beside[pair[0]].1 = Some(pair[1]);
        room.beside[pair[1]].0 = Some(pair[0]);
    }
    for _ in 0..ROUNDS {
        let before = x.clone();
        for chain in &it.chains {
            let mut first = 1;
            while first + 1 < chain.len() {
                let straight = chain[first..chain.len() - 1]
                    .iter()
                    .take_while(|&&at| x[at] == x[chain[first]]);
                let next = first + straight.count();
                let ends = [x[chain[first - 1]], x[chain[next]]];
                room.shift(x, &chain[first..next], ends.into_iter());
                first = next;
            }
        }
        for node in (0..x.len()).filter(|&at| it.kinds[at] == Vertex::Node) {
            let around: Vec<i64> =
                it.above[node].iter().chain(&it.below[node]).map(|&to| x[to]).collect();
            room.shift(x, &[node], around.into_iter());
        }
        if *x == before {
            break;
        }
    }
}

/// The neighbours of each vertex in its layer, left and right.
struct Room<'l> {
    it: &'l Layered,
    beside: Vec<(Option<usize>, Option<usize>)>,
}

impl Room<'_> {
    /// Moves vertices of the same x into the range of others, as far as those beside them let it.
    fn shift(&self, x: &mut [i64], vertices: &[usize], range: impl Iterator<Item = i64> + Clone) {
        let (Some(least), Some(most)) = (range.clone().min(), range.max()) else { return };
        let here = x[vertices[0]];
        let it = self.it;
        let free_left =
            |&at: &usize| self.beside[at].0.map(|to| x[to] + it.right[to] + it.left[at]);
        let free_right =
            |&at: &usize| self.beside[at].1.map(|to| x[to] - it.left[to] - it.right[at]);
        let there = if here < least {
            vertices.iter().filter_map(free_right).fold(least, i64::min).max(here)
        } else if here > most {
            vertices.iter().filter_map(free_left).fold(most, i64::max).min(here)
        } else {
            here
        };
        for &at in vertices {
            x[at] = there;
        }
    }
}

/// The neighbours to be aligned with: along forward edges if there are any, so that the main course
/// runs straight.
fn main(it: &Layered, neighbours: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut is_forward = BTreeSet::new();
    for (chain, _) in it.chains.iter().zip(&it.backward).filter(|(_, backward)| !**backward) {
        is_forward
            .extend(chain.windows(2).flat_map(|pair| [(pair[0], pair[1]), (pair[1], pair[0])]));
    }
    let chosen = |(vertex, around): (usize, &Vec<usize>)| {
        let forward: Vec<usize> =
            around.iter().copied().filter(|&to| is_forward.contains(&(vertex, to))).collect();
        if forward.is_empty() { around.clone() } else { forward }
    };
    neighbours.iter().enumerate().map(chosen).collect()
}

/// Lines, by upper and lower vertex, that cross a piece of a long edge. They yield to it.
fn conflicts(it: &Layered) -> BTreeSet<(usize, usize)> {
    let mut conflicts = BTreeSet::new();
    let mut position = vec![0; it.kinds.len()];
    for layer in &it.layers {
        for (at, &vertex) in layer.iter().enumerate() {
            position[vertex] = at;
        }
    }
    let inner = |vertex: usize| {
        let above = it.above[vertex].first().copied()?;
        (it.kinds[vertex] != Vertex::Node && it.kinds[above] != Vertex::Node).then_some(above)
    };
    for lower in it.layers.iter().skip(1) {
        let mut least = 0;
        let mut first = 0;
        for (at, &vertex) in lower.iter().enumerate() {
            let long = inner(vertex);
            if long.is_none() && at + 1 < lower.len() {
                continue;
            }
            let most = long.map_or(usize::MAX, |above| position[above]);
            for &crossing in &lower[first..=at] {
                for &above in it.above[crossing].iter().filter(|_| inner(crossing).is_none()) {
                    if position[above] < least || position[above] > most {
                        conflicts.insert((above, crossing));
                    }
                }
            }
            first = at + 1;
            least = long.map_or(least, |above| position[above]);
        }
    }
    conflicts
}

/// By vertex: the first vertex of its block.
fn align(
    layers: &[Vec<usize>],
    neighbours: &[Vec<usize>],
    conflicts: &BTreeSet<(usize, usize)>,
) -> Vec<usize> {
    let mut block: Vec<usize> = (0..neighbours.len()).collect();
    let mut continued = vec![false; neighbours.len()];
    let mut position = vec![0; neighbours.len()];
    for layer in layers {
        // The first position of the layer before that can still be aligned with, without a
        // crossing.
        let mut free = 0;
        for &vertex in layer {
            let mut around = neighbours[vertex].clone();
            around.sort_unstable_by_key(|&to| position[to]);
            let Some(last) = around.len().checked_sub(1) else { continue };
            for &to in &around[last / 2..=last.div_ceil(2)] {
                let conflict =
                    conflicts.contains(&(to, vertex)) || conflicts.contains(&(vertex, to));
                if block[vertex] == vertex && !continued[to] && position[to] >= free && !conflict {
                    continued[to] = true;
                    block[vertex] = block[to];
                    free = position[to] + 1;
                }
            }
        }
        for (at, &vertex) in layer.iter().enumerate() {
            position[vertex] = at;
        }
    }
    block
}

/// Packs the blocks to the left, then each as far to the right as the others let it.
fn pack(layers: &[Vec<usize>], block: &[usize], before: &[i64], after: &[i64]) -> Vec<i64> {
    let mut next = vec![Vec::new(); block.len()];
    let mut waits_for = vec![0; block.len()];
    for pair in layers.iter().flat_map(|layer| layer.windows(2)) {
        next[block[pair[0]]].push((block[pair[1]], after[pair[0]] + before[pair[1]]));
        waits_for[block[pair[1]]] += 1;
    }
    let is_first = |at: &usize| block[*at] == *at;
    let mut order: Vec<usize> =
        (0..block.len()).filter(is_first).filter(|&at| waits_for[at] == 0).collect();
    let mut x = vec![0; block.len()];
    let mut done = 0;
    while let Some(&at) = order.get(done) {
        done += 1;
        for &(to, distance) in &next[at] {
            x[to] = x[to].max(x[at] + distance);
            waits_for[to] -= 1;
            if waits_for[to] == 0 {
                order.push(to);
            }
        }
    }
    for &at in order.iter().rev() {
        if let Some(most) = next[at].iter().map(|&(to, distance)| x[to] - distance).min() {
            x[at] = x[at].max(most);
        }
    }
    block.iter().map(|&first| x[first]).collect()
}
