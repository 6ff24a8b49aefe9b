//! A second meaning of a time net, by integer clocks that tick together: exact when no bound is
//! open.
//!
//! It shares nothing with the classes but the data of the net.

use cotama_verification::tpn::{TimeNet, TimeTransition};
use std::collections::{BTreeSet, HashMap, VecDeque};

/// Tokens, and for each transition its clock when it is enabled. A clock that nothing is to see any
/// more stands still.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct State {
    pub(crate) tokens: Vec<u32>,
    pub(crate) clocks: Vec<Option<u64>>,
}

/// All states that firings and ticks reach.
pub(crate) struct States {
    pub(crate) list: Vec<State>,
    /// The edges of each state: a transition with its successor, or `None` for a tick.
    pub(crate) edges: Vec<Vec<(Option<usize>, usize)>>,
}

pub(crate) fn enabled(transition: &TimeTransition, tokens: &[u32]) -> bool {
    transition
        .take
        .iter()
        .chain(&transition.read)
        .all(|arc| tokens[arc.place.0 as usize] >= arc.weight)
}

/// Returns the marking after a firing, and for each transition whether it is newly enabled by it,
/// or goes on.
pub(crate) fn fire(net: &TimeNet, tokens: &[u32], fired: usize) -> (Vec<u32>, Vec<Option<bool>>) {
    let mut between = tokens.to_vec();
    for arc in &net.transitions()[fired].take {
        between[arc.place.0 as usize] -= arc.weight;
    }
    let mut after = between.clone();
    for arc in &net.transitions()[fired].give {
        after[arc.place.0 as usize] += arc.weight;
    }
    let new = |(at, it): (usize, &TimeTransition)| {
        enabled(it, &after).then(|| at == fired || !enabled(it, &between))
    };
    let clocks = net.transitions().iter().enumerate().map(new).collect();
    (after, clocks)
}

/// All states; `None` when there are more than `most` or a place gets more than `tokens`.
pub(crate) fn states(net: &TimeNet, most: usize, tokens: u32) -> Option<States> {
    let initial: Vec<u32> = net.places().iter().map(|it| it.initial).collect();
    let clocks = net.transitions().iter().map(|it| enabled(it, &initial).then_some(0)).collect();
    let mut list = vec![State { tokens: initial, clocks }];
    let mut numbers = HashMap::from([(list[0].clone(), 0)]);
    let mut edges: Vec<Vec<(Option<usize>, usize)>> = Vec::new();
    while edges.len() < list.len() {
        let state = list[edges.len()].clone();
        let mut out = Vec::new();
        let firings = (0..net.transitions().len()).filter_map(|fired| {
            let interval = net.transitions()[fired].interval;
            let clock = state.clocks[fired]?;
            (clock >= interval.lower).then(|| {
                let (tokens, new) = fire(net, &state.tokens, fired);
                let clock = |(at, new): (usize, &Option<bool>)| match new {
                    None => None,
                    Some(true) => Some(0),
                    Some(false) => state.clocks[at],
                };
                let clocks = new.iter().enumerate().map(clock).collect();
                (Some(fired), State { tokens, clocks })
            })
        });
        let due = |(it, clock): (&TimeTransition, &Option<u64>)| {
            clock.is_some_and(|at| it.interval.upper == Some(at))
        };
        let stopped = net.transitions().iter().zip(&state.clocks).any(due);
        let tick = (!stopped).then(|| {
            let ticked = |(it, clock): (&TimeTransition, &Option<u64>)| {
                clock.map(|at| {
                    if it.interval.upper.is_none() {
                        (at + 1).min(it.interval.lower)
                    } else {
                        at + 1
                    }
                })
            };
            let clocks = net.transitions().iter().zip(&state.clocks).map(ticked).collect();
            (None, State { tokens: state.tokens.clone(), clocks })
        });
        for (fired, next) in firings.chain(tick) {
            if next.tokens.iter().any(|&it| it > tokens) {
                return None;
            }
            let number = *numbers.entry(next).or_insert_with_key(|next| {
                list.push(next.clone());
                list.len() - 1
            });
            out.push((fired, number));
        }
        edges.push(out);
        if list.len() > most {
            return None;
        }
    }
    Some(States { list, edges })
}

impl States {
    /// The different markings.
    pub(crate) fn markings(&self) -> BTreeSet<Vec<u32>> {
        self.list.iter().map(|it| it.tokens.clone()).collect()
    }

    /// Returns the markings that enable nothing.
    pub(crate) fn dead(&self) -> BTreeSet<Vec<u32>> {
        self.list
            .iter()
            .filter(|it| it.clocks.iter().all(Option::is_none))
            .map(|it| it.tokens.clone())
            .collect()
    }

    /// The least and the most number of ticks from a firing until a place is marked, as the command
    /// line shows it.
    pub(crate) fn bound(&self, from: usize, to: usize) -> String {
        let marked = |state: usize| self.list[state].tokens[to] > 0;
        let entries: BTreeSet<usize> = self
            .edges
            .iter()
            .flatten()
            .filter(|it| it.0 == Some(from))
            .map(|&(_, target)| target)
            .collect();
        if entries.is_empty() {
            return "never fires".to_owned();
        }
        let mut best: Vec<Option<u64>> = vec![None; self.list.len()];
        let mut queue: VecDeque<(u64, usize)> = entries.iter().map(|&it| (0, it)).collect();
        let mut min = None;
        while let Some((ticks, state)) = queue.pop_front() {
            if marked(state) {
                min = Some(ticks);
                break;
            }
            if best[state].is_some() {
                continue;
            }
            best[state] = Some(ticks);
            for &(fired, next) in &self.edges[state] {
                if fired.is_some() {
                    queue.push_front((ticks, next));
                } else {
                    queue.push_back((ticks + 1, next));
                }
            }
        }
        // A state that is still looked at has no limit: to come back to it is a cycle.
        let mut most: HashMap<usize, Option<u64>> = HashMap::new();
        let longest =
            entries.iter().map(|&it| self.longest(it, &marked, &mut most)).reduce(later).unwrap();
        let shown = |time: Option<u64>| time.map_or("inf".to_owned(), |it| it.to_string());
        format!("{}..{}", shown(min), shown(longest))
    }

    fn longest(
        &self,
        state: usize,
        marked: &impl Fn(usize) -> bool,
        most: &mut HashMap<usize, Option<u64>>,
    ) -> Option<u64> {
        if marked(state) {
            return Some(0);
        }
        if let Some(known) = most.get(&state) {
            return *known;
        }
        most.insert(state, None);
        let after = |(fired, next): &(Option<usize>, usize)| {
            self.longest(*next, marked, most).map(|it| it + u64::from(fired.is_none()))
        };
        let longest = self.edges[state].iter().map(after).reduce(later).flatten();
        most.insert(state, longest);
        longest
    }
}

/// The later of two times; `None` is without limit.
fn later(a: Option<u64>, b: Option<u64>) -> Option<u64> {
    Some(a?.max(b?))
}
