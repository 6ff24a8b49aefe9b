//! Which variables can tell of which others: d-separation, with an open path where there is one
//! (Koller and Friedman, Probabilistic Graphical Models, 2009, algorithm 3.1).

use crate::network::Network;
use std::collections::VecDeque;

/// A way in which a variable is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// Against an arc, from a child, or as the beginning.
    Up,
    /// Along an arc, from a parent.
    Down,
}

/// An open path: each variable, and whether the arc to the next one points forward.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OpenPath {
    /// The variables on the path, from one end to the other.
    pub variables: Vec<usize>,
    /// For each pair of neighbours whether the arc points from the first to the second.
    pub forward: Vec<bool>,
}

impl Network {
    /// Returns an open path from `from` to `to` given the states of other variables, a shortest
    /// one; none where these separate both, so that one tells nothing of the other.
    ///
    /// A path is open where every variable on it with arcs of the path pointing at it from both
    /// sides is given or has a given descendant, and no other variable on it is given.
    ///
    /// ```
    /// # use cotama_risk::Network;
    /// let text = "network n { }
    ///     variable rain { type discrete [ 2 ] { yes, no }; }
    ///     variable pipe { type discrete [ 2 ] { ok, broken }; }
    ///     variable wet { type discrete [ 2 ] { yes, no }; }
    ///     probability ( rain ) { table 0.5, 0.5; } probability ( pipe ) { table 0.9, 0.1; }
    ///     probability ( wet | rain, pipe ) { default 0.9, 0.1; (no, ok) 0.1, 0.9; }";
    /// let (net, _) = Network::from_bif(text).unwrap();
    /// assert!(net.open_path(0, 1, &[]).is_none());
    /// let path = net.open_path(0, 1, &[2]).unwrap(); // one cause speaks against the other
    /// assert_eq!((path.variables, path.forward), (vec![0, 2, 1], vec![true, false]));
    /// ```
    pub fn open_path(&self, from: usize, to: usize, given: &[usize]) -> Option<OpenPath> {
        let nodes = self.nodes();
        if given.contains(&from) || given.contains(&to) {
            return None;
        }
        let mut tells = vec![false; nodes.len()];
        let mut stack = given.to_vec();
        while let Some(next) = stack.pop() {
            if !std::mem::replace(&mut tells[next], true) {
                stack.extend(&nodes[next].parents);
            }
        }
        let children = self.children();
        let at = |(variable, way): (usize, Way)| 2 * variable + usize::from(way == Way::Down);
        let mut before: Vec<Option<(usize, Way)>> = vec![None; 2 * nodes.len()];
        let mut open = VecDeque::from([(from, Way::Up)]);
        before[at((from, Way::Up))] = Some((from, Way::Up));
        while let Some(now) = open.pop_front() {
            let (variable, way) = now;
            if variable == to {
                return Some(traced(&before, now, at));
            }
            let is_given = given.contains(&variable);
            let up = match way {
                Way::Up => !is_given,
                Way::Down => tells[variable],
            };
            let up = nodes[variable].parents.iter().filter(|_| up).map(|it| (*it, Way::Up));
            let down = children[variable].iter().filter(|_| !is_given).map(|it| (*it, Way::Down));
            for next in up.chain(down) {
                if before[at(next)].is_none() {
                    before[at(next)] = Some(now);
                    open.push_back(next);
                }
            }
        }
        None
    }
}

fn traced(
    before: &[Option<(usize, Way)>],
    mut now: (usize, Way),
    at: impl Fn((usize, Way)) -> usize,
) -> OpenPath {
    let (mut variables, mut forward) = (vec![now.0], Vec::new());
    while let Some(last) = before[at(now)].filter(|it| *it != now) {
        forward.push(now.1 == Way::Down);
        variables.push(last.0);
        now = last;
    }
    variables.reverse();
    forward.reverse();
    OpenPath { variables, forward }
}
