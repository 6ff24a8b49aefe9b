//! State classes as the textbook has them: inequalities, closed by Floyd and Warshall after every
//! firing.

use crate::tpn::discrete::{enabled, fire};
use cotama_verification::tpn::{Interval, TimeNet};
use std::collections::HashMap;

/// An upper bound of a difference: its value, and 1 when it is included, 0 when it is not. `None`:
/// no bound.
type Bound = Option<(i64, i64)>;
type Matrix = Vec<Vec<Bound>>;

fn sum(a: Bound, b: Bound) -> Bound {
    a.zip(b).map(|(a, b)| (a.0 + b.0, a.1 * b.1))
}

fn least(a: Bound, b: Bound) -> Bound {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        _ => a.or(b),
    }
}

/// Bounds as tight as they follow from each other; `None` when nothing satisfies them.
fn closed(mut matrix: Matrix) -> Option<Matrix> {
    let all = 0..matrix.len();
    for via in all.clone() {
        for from in all.clone() {
            for to in all.clone() {
                matrix[from][to] = least(matrix[from][to], sum(matrix[from][via], matrix[via][to]));
            }
        }
    }
    all.clone().all(|at| matrix[at][at] == Some((0, 1))).then_some(matrix)
}

/// Bounds between zero and the times of these transitions; `before` gives those that are known.
fn class(
    net: &TimeNet,
    enabled: &[usize],
    before: impl Fn(Option<usize>, Option<usize>) -> Bound,
) -> Option<Matrix> {
    let nodes: Vec<Option<usize>> =
        std::iter::once(None).chain(enabled.iter().copied().map(Some)).collect();
    let row = |&from: &Option<usize>| {
        nodes.iter().map(|&to| if from == to { Some((0, 1)) } else { before(from, to) }).collect()
    };
    let mut matrix: Matrix = nodes.iter().map(row).collect();
    for (at, &transition) in (1..).zip(enabled) {
        let zero = (0..nodes.len())
            .all(|other| other == at || matrix[at][other].is_none() && matrix[other][at].is_none());
        if zero {
            let Interval { lower, lower_strict, upper, upper_strict } =
                net.transitions()[transition].interval;
            matrix[0][at] = Some((-lower.cast_signed(), i64::from(!lower_strict)));
            matrix[at][0] = upper.map(|upper| (upper.cast_signed(), i64::from(!upper_strict)));
        }
    }
    closed(matrix)
}

/// How many classes and edges there are; `None` when there are more than `most` classes.
pub(crate) fn classes(net: &TimeNet, most: usize) -> Option<(usize, usize)> {
    let initial: Vec<u32> = net.places().iter().map(|it| it.initial).collect();
    let all = 0..net.transitions().len();
    let start: Vec<usize> = all.filter(|&it| enabled(&net.transitions()[it], &initial)).collect();
    let first = (initial, start.clone(), class(net, &start, |_, _| None)?);
    let mut numbers = HashMap::from([(first.clone(), 0)]);
    let mut open = vec![first];
    let mut edges = 0;
    while let Some((marking, transitions, matrix)) = open.pop() {
        for (position, &fired) in (1..).zip(&transitions) {
            let mut firing = matrix.clone();
            for bound in &mut firing[position][1..] {
                *bound = least(*bound, Some((0, 1)));
            }
            let Some(firing) = closed(firing) else { continue };
            edges += 1;
            let (after, new) = fire(net, &marking, fired);
            let next: Vec<usize> = (0..new.len()).filter(|&it| new[it].is_some()).collect();
            // The time of the firing is the new zero.
            let at = |node: Option<usize>| match node {
                None => Some(position),
                Some(it) if new[it] == Some(false) => {
                    transitions.iter().position(|&old| old == it).map(|it| it + 1)
                }
                Some(_) => None,
            };
            let domain = class(net, &next, |from, to| firing[at(from)?][at(to)?])?;
            let target = (after, next, domain);
            let count = numbers.len();
            if !numbers.contains_key(&target) {
                numbers.insert(target.clone(), count);
                open.push(target);
            }
        }
        if numbers.len() > most {
            return None;
        }
    }
    Some((numbers.len(), edges))
}
