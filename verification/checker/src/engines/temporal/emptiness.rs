//! Whether some run of a net is as a formula says: the search for a component of the product in
//! which no promise is kept up for ever.
//!
//! J.-M. Couvreur's algorithm (1999): one depth first search, which merges components as cycles
//! close, and ends as soon as the merged ones have all that is needed.

use super::product::Product;
use super::source::Source;
use super::stop::{NONE, Stop};
use crate::explicit::Progress;
use cotama_core::net::TransitionId;
use cotama_property::Ltl;
use cotama_property::run::{Rest, Run};
use std::collections::VecDeque;

/// Pairs between two looks at the clock.
const TICK: u32 = 256;

/// The outcome of a search for a run, and the number of markings met.
#[derive(Debug)]
pub(super) struct Searched {
    pub(super) run: Result<Option<Run>, Stop>,
    pub(super) states: u64,
}

/// Searches for a run from the first state of which a formula is true.
pub(super) fn some_run<S: Source>(
    source: Result<S, Stop>,
    formula: &Ltl,
    progress: &dyn Fn(Progress),
) -> Searched {
    let product = match source.and_then(|it| Product::new(it, formula)) {
        Ok(product) => product,
        Err(stop) => return Searched { run: Err(stop), states: 0 },
    };
    let mut search = Search {
        all: product.automaton.promises(),
        product,
        visits: Vec::new(),
        ways: Vec::new(),
        roots: Vec::new(),
        live: Vec::new(),
        marks: Vec::new(),
        met: 0,
    };
    let found = search.run(progress);
    let run = found.map(|end| end.map(|end| search.evidence(&end)));
    Searched { run, states: search.product.source.len() as u64 }
}

/// A pair that is being visited.
struct Visit {
    pair: u32,
    /// Start of its edges, and the next one.
    start: usize,
    next: (usize, usize),
    moves: Vec<super::automaton::Move>,
    /// Whether some transitions are left out.
    is_reduced: bool,
}

/// The first pair of a component as far as it is known.
struct Root {
    /// When it was met.
    met: u32,
    /// The promises missing on the step into it, and on the steps inside.
    into: u128,
    kept: u128,
}

/// The state of a pair in the search.
#[derive(Clone, Copy, Default)]
struct Mark {
    /// When it was met; 0 if it was not, or if its component is left.
    met: u32,
    /// Whether it is being visited.
    on_way: bool,
    /// Whether its component is left.
    is_left: bool,
}

/// The evidence that there is a run.
enum End {
    /// From here every run will do.
    Any(u32),
    /// A component, and all that is needed: those of its pairs were met at this time or later.
    Component(u32),
}

struct Search<'a, S> {
    all: u128,
    product: Product<'a, S>,
    visits: Vec<Visit>,
    /// Transitions and the markings after them, of all visits.
    ways: Vec<(u32, u32)>,
    roots: Vec<Root>,
    /// Pairs of components that are not left.
    live: Vec<u32>,
    marks: Vec<Mark>,
    met: u32,
}

impl<S: Source> Search<'_, S> {
    fn run(&mut self, progress: &dyn Fn(Progress)) -> Result<Option<End>, Stop> {
        if self.product.automaton.accepts_all(0) {
            return Ok(Some(End::Any(0)));
        }
        self.enter(0, 0)?;
        while let Some(visit) = self.visits.last_mut() {
            let (path, at) = visit.next;
            if path == self.ways.len() {
                self.leave();
                continue;
            }
            if at == 0 && self.product.sees_firings() {
                visit.moves = self.product.moves(visit.pair, self.ways[path].0)?;
            }
            let Some(step) = visit.moves.get(at).copied() else {
                visit.next = (path + 1, 0);
                continue;
            };
            visit.next = (path, at + 1);
            let kept = self.all & !step.promises;
            let to = self.product.pair(self.ways[path].1, step.to)?;
            let met = self.product.len();
            self.product.source.memory().extend(&mut self.marks, met, Mark::default())?;
            let mark = self.marks[to as usize];
            if mark.is_left {
                continue;
            }
            if mark.met == 0 {
                if self.product.automaton.accepts_all(step.to) {
                    return Ok(Some(End::Any(to)));
                }
                if self.met.is_multiple_of(TICK) {
                    self.product.source.check_time()?;
                    let states = self.product.source.len() as u64;
                    let (depth, waiting) = (self.visits.len() as u64, self.live.len() as u64);
                    progress(Progress { states, depth, waiting });
                }
                self.enter(to, kept)?;
                continue;
            }
            if mark.on_way {
                self.complete()?;
            }
            let all = self.all;
            if let Some(root) = self.merge(mark.met, kept).filter(|it| it.kept == all) {
                return Ok(Some(End::Component(root.met)));
            }
        }
        Ok(None)
    }

    fn enter(&mut self, pair: u32, into: u128) -> Result<(), Stop> {
        let met = self.product.len();
        let memory = self.product.source.memory();
        memory.room(&mut self.visits, 1)?;
        memory.room(&mut self.roots, 1)?;
        memory.room(&mut self.live, 1)?;
        memory.extend(&mut self.marks, met, Mark::default())?;
        self.met += 1;
        self.marks[pair as usize] = Mark { met: self.met, on_way: true, is_left: false };
        self.live.push(pair);
        self.roots.push(Root { met: self.met, into, kept: 0 });
        let moves = self.product.moves(pair, NONE)?;
        let marking = self.product.of(pair).0;
        let start = self.ways.len();
        let mut is_reduced = false;
        if !moves.is_empty() || self.product.sees_firings() {
            let few = self.product.source.few(marking);
            is_reduced = few.is_some();
            let transitions = few.unwrap_or_else(|| self.product.source.transitions(marking));
            self.fire(marking, &transitions)?;
        }
        self.visits.push(Visit { pair, start, next: (start, 0), moves, is_reduced });
        Ok(())
    }

    fn fire(&mut self, marking: u32, transitions: &[u32]) -> Result<(), Stop> {
        self.product.source.memory().room(&mut self.ways, transitions.len())?;
        for &transition in transitions {
            let after = self.product.source.fire(marking, transition)?;
            self.ways.push((transition, after));
        }
        Ok(())
    }

    /// Adds the transitions that were left out to the visit that is under way: on each cycle they
    /// are fired somewhere.
    fn complete(&mut self) -> Result<(), Stop> {
        let Some(visit) = self.visits.last_mut().filter(|it| it.is_reduced) else { return Ok(()) };
        visit.is_reduced = false;
        let (start, marking) = (visit.start, self.product.of(visit.pair).0);
        let mut rest = self.product.source.transitions(marking);
        rest.retain(|it| self.ways[start..].iter().all(|path| path.0 != *it));
        self.fire(marking, &rest)
    }

    /// Merges the components that a cycle leads through.
    fn merge(&mut self, met: u32, kept: u128) -> Option<&Root> {
        let mut kept = kept;
        while let Some(root) = self.roots.pop_if(|it| it.met > met) {
            kept |= root.kept | root.into;
        }
        let root = self.roots.last_mut()?;
        root.kept |= kept;
        Some(root)
    }

    fn leave(&mut self) {
        let Some(visit) = self.visits.pop() else { return };
        self.ways.truncate(visit.start);
        let mark = &mut self.marks[visit.pair as usize];
        mark.on_way = false;
        let met = mark.met;
        if self.roots.pop_if(|it| it.met == met).is_some() {
            while let Some(pair) = self.live.pop() {
                self.marks[pair as usize].is_left = true;
                if pair == visit.pair {
                    break;
                }
            }
        }
    }

    /// A short run that shows what was found.
    fn evidence(&mut self, end: &End) -> Run {
        let (first, component) = match *end {
            End::Any(pair) => (self.path(0, |_, to, _| to == pair), None),
            End::Component(met) => {
                let inside = |mark: Mark| mark.met >= met && !mark.is_left;
                if inside(self.marks[0]) {
                    (Some(Way { fired: Vec::new(), to: 0, promises: 0 }), Some(met))
                } else {
                    let marks = self.marks.clone();
                    (self.path(0, |_, to, _| inside(marks[to as usize])), Some(met))
                }
            }
        };
        let first = first.unwrap_or_default();
        let stem = fired(&first.fired);
        let Some(met) = component else { return Run { stem, rest: Rest::Any } };
        let marks = self.marks.clone();
        let inside = |pair: u32| marks[pair as usize].met >= met && !marks[pair as usize].is_left;
        let (mut cycle, mut at, mut open) = (Vec::new(), first.to, self.all);
        while open != 0 {
            let step = |_, to, promises: u128| inside(to) && open & !promises != 0;
            let Some(path) = self.path_inside(at, &inside, step) else { break };
            cycle.extend(path.fired);
            (at, open) = (path.to, open & path.promises);
        }
        if at != first.to || cycle.is_empty() {
            let back = self.path_inside(at, &inside, |_, to, _| to == first.to);
            cycle.extend(back.unwrap_or_default().fired);
        }
        if cycle.contains(&NONE) {
            Run { stem, rest: Rest::Stays }
        } else {
            Run::lasso(stem, fired(&cycle), self.product.source.is_injective())
        }
    }

    fn path(&mut self, from: u32, is_last: impl Fn(u32, u32, u128) -> bool) -> Option<Way> {
        self.path_inside(from, &|_| true, is_last)
    }

    /// A shortest path of at least one step from a pair, through these pairs, up to and with a step
    /// that is the last one.
    fn path_inside(
        &mut self,
        from: u32,
        inside: &impl Fn(u32) -> bool,
        is_last: impl Fn(u32, u32, u128) -> bool,
    ) -> Option<Way> {
        let mut before: Vec<Option<(u32, u32)>> = vec![None; self.product.len()];
        let mut queue = VecDeque::from([from]);
        while let Some(pair) = queue.pop_front() {
            for (transition, to, promises) in self.product.steps(pair) {
                if is_last(pair, to, promises) {
                    let (mut fired, mut at) = (vec![transition], pair);
                    while at != from {
                        let Some((pair, transition)) = before[at as usize] else { break };
                        fired.push(transition);
                        at = pair;
                    }
                    fired.reverse();
                    return Some(Way { fired, to, promises });
                }
                if inside(to) && to != from && before[to as usize].is_none() {
                    before[to as usize] = Some((pair, transition));
                    queue.push_back(to);
                }
            }
        }
        None
    }
}

/// A path through the product.
#[derive(Default)]
struct Way {
    fired: Vec<u32>,
    to: u32,
    /// The promises of its last step.
    promises: u128,
}

fn fired(transitions: &[u32]) -> Vec<TransitionId> {
    transitions.iter().filter(|it| **it != NONE).map(|it| TransitionId(*it)).collect()
}
