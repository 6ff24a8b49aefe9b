//! The meaning of formulas by the book, on all reachable markings of a small net: slow, and written
//! to be obviously right. Engines are compared with it.

use cotama_core::net::PlaceId;
use cotama_verification::property::{Atom, Formula, Linear, Question};
use cotama_verification::pt::Pt;
use std::collections::HashMap;

/// Whether a formula holds at the start.
pub(crate) fn holds(net: &Pt, formula: &Formula) -> bool {
    Space::new(net).satisfying(formula)[0]
}

/// The most tokens that these places ever hold together.
pub(crate) fn bound(net: &Pt, places: &[PlaceId]) -> u64 {
    let tokens =
        |marking: &Vec<u32>| places.iter().map(|it| u64::from(marking[it.0 as usize])).sum();
    Space::new(net).markings.iter().map(tokens).max().unwrap()
}

/// The answer to a question of yes or no; `None` to any other.
pub(crate) fn verdict(net: &Pt, question: &Question) -> Option<bool> {
    Space::new(net).verdict(question)
}

/// All reachable markings, the initial one first, with the transitions that are enabled in each,
/// and their successors.
pub(crate) struct Space<'n> {
    pub(crate) net: &'n Pt,
    pub(crate) markings: Vec<Vec<u32>>,
    pub(crate) enabled: Vec<Vec<u32>>,
    pub(crate) successors: Vec<Vec<usize>>,
}

impl<'n> Space<'n> {
    /// The space of a net with at most 100,000 markings.
    pub(crate) fn new(net: &'n Pt) -> Self {
        let (mut markings, mut successors) = (vec![net.initial.clone()], Vec::new());
        let mut enabled = Vec::new();
        let mut positions = HashMap::from([(net.initial.clone(), 0)]);
        while let Some(marking) = markings.get(successors.len()).cloned() {
            let fires = (0..net.transitions.len() as u32).filter(|&it| net.enabled(&marking, it));
            enabled.push(fires.collect::<Vec<_>>());
            let next = enabled[successors.len()].iter().map(|it| {
                let after = net.fire(&marking, *it).unwrap();
                *positions.entry(after.clone()).or_insert_with(|| {
                    markings.push(after);
                    markings.len() - 1
                })
            });
            successors.push(next.collect());
            assert!(markings.len() <= 100_000, "the net {} is too large for the oracle", net.name);
        }
        Self { net, markings, enabled, successors }
    }

    /// Markings that were met elsewhere, with their successors.
    pub(crate) fn of(net: &'n Pt, markings: Vec<Vec<u32>>, successors: Vec<Vec<usize>>) -> Self {
        let transitions = || 0..net.transitions.len() as u32;
        let fires = |at: &Vec<u32>| transitions().filter(|it| net.enabled(at, *it)).collect();
        let enabled = markings.iter().map(fires).collect();
        Self { net, markings, enabled, successors }
    }

    /// The answer to a question of yes or no; `None` to any other.
    pub(crate) fn verdict(&self, question: &Question) -> Option<bool> {
        let fires_from = |marking: usize, transition: u32| {
            self.reaching(&|at| self.enabled[at].contains(&transition))[marking]
        };
        let transitions = 0..self.net.transitions.len() as u32;
        let always =
            |place: usize| self.markings.iter().all(|it| it[place] == self.net.initial[place]);
        match question {
            Question::Formula(formula) => Some(self.satisfying(formula)[0]),
            Question::Liveness => Some(
                (0..self.markings.len()).all(|at| transitions.clone().all(|it| fires_from(at, it))),
            ),
            Question::QuasiLiveness => Some(transitions.clone().all(|it| fires_from(0, it))),
            Question::StableMarking => Some((0..self.net.places.len()).any(always)),
            Question::OneSafe => Some(self.markings.iter().flatten().all(|&tokens| tokens <= 1)),
            Question::Bound(_) | Question::Response { .. } | Question::Fair(..) => None,
        }
    }

    /// In which markings a formula holds that speaks of no run.
    pub(crate) fn satisfying(&self, formula: &Formula) -> Vec<bool> {
        let all = 0..self.markings.len();
        match formula {
            Formula::Atom(atom) => all.map(|at| self.atom(atom, at)).collect(),
            Formula::Not(inner) => self.satisfying(inner).into_iter().map(|it| !it).collect(),
            Formula::And(parts) => {
                let parts: Vec<_> = parts.iter().map(|it| self.satisfying(it)).collect();
                all.map(|at| parts.iter().all(|part| part[at])).collect()
            }
            Formula::Or(parts) => {
                let parts: Vec<_> = parts.iter().map(|it| self.satisfying(it)).collect();
                all.map(|at| parts.iter().any(|part| part[at])).collect()
            }
            Formula::Exists(path) => match &**path {
                Formula::Next(inner) if !inner.needs_run() => {
                    let inner = self.satisfying(inner);
                    all.map(|at| self.successors[at].iter().any(|&it| inner[it])).collect()
                }
                path => self.some_run(path),
            },
            Formula::All(path) => match &**path {
                Formula::Next(inner) if !inner.needs_run() => {
                    let inner = self.satisfying(inner);
                    all.map(|at| self.successors[at].iter().all(|&it| inner[it])).collect()
                }
                path => {
                    let counterexample = Formula::Not(Box::new(path.clone()));
                    self.some_run(&counterexample).into_iter().map(|it| !it).collect()
                }
            },
            _ => panic!("{formula:?} speaks of a run"),
        }
    }

    pub(crate) fn atom(&self, atom: &Atom, at: usize) -> bool {
        let enabled = |transition: u32| self.enabled[at].contains(&transition);
        match atom {
            Atom::AtMost(linear) => at_most(linear, &self.markings[at]),
            Atom::Fireable(transitions) => transitions.iter().any(|it| enabled(it.0)),
            Atom::Deadlock => self.enabled[at].is_empty(),
        }
    }

    /// From which markings one with a property is reachable, itself included.
    pub(crate) fn reaching(&self, goal: &dyn Fn(usize) -> bool) -> Vec<bool> {
        let mut reaching: Vec<bool> = (0..self.markings.len()).map(goal).collect();
        while let Some(at) = (0..reaching.len())
            .find(|&at| !reaching[at] && self.successors[at].iter().any(|&it| reaching[it]))
        {
            reaching[at] = true;
        }
        reaching
    }

    /// Returns the successors of a marking on a run; after a deadlock it lasts.
    pub(crate) fn run_successors(&self, at: usize) -> Vec<usize> {
        if self.successors[at].is_empty() { vec![at] } else { self.successors[at].clone() }
    }

    /// From which markings some run is as a formula says.
    fn some_run(&self, path: &Formula) -> Vec<bool> {
        Product::new(self, path).satisfying(path)
    }
}

pub(crate) fn at_most(linear: &Linear, marking: &[u32]) -> bool {
    let tokens = |&(place, weight): &(PlaceId, i64)| {
        i128::from(marking[place.0 as usize]) * i128::from(weight)
    };
    i128::from(linear.constant) + linear.weights.iter().map(tokens).sum::<i128>() <= 0
}

/// Markings together with a guess which temporal parts of a formula are true of the rest of the
/// run. A guess is right when it fits to the next one by the expansion laws (`F a = a | X F a` and
/// so on), and when everything that it says will come does come.
struct Product<'a> {
    /// The temporal parts; a guess has a bit for each.
    temporal: Vec<Formula>,
    /// The markings in which parts hold that need no run.
    state: HashMap<Formula, Vec<bool>>,
    space: &'a Space<'a>,
    successors: Vec<Vec<usize>>,
}

impl<'a> Product<'a> {
    fn new(space: &'a Space<'a>, path: &Formula) -> Self {
        let mut product =
            Self { temporal: Vec::new(), state: HashMap::new(), space, successors: Vec::new() };
        product.collect(path);
        let nodes = space.markings.len() << product.temporal.len();
        product.successors = (0..nodes).map(|node| product.fitting(node)).collect();
        product
    }

    fn collect(&mut self, formula: &Formula) {
        if !formula.needs_run() {
            let holds = self.space.satisfying(formula);
            self.state.insert(formula.clone(), holds);
            return;
        }
        match formula {
            Formula::Not(a) | Formula::Next(a) | Formula::Finally(a) | Formula::Globally(a) => {
                self.collect(a);
            }
            Formula::And(all) | Formula::Or(all) => all.iter().for_each(|it| self.collect(it)),
            Formula::Until(a, b) => {
                self.collect(a);
                self.collect(b);
            }
            _ => panic!("{formula:?} has no meaning without time"),
        }
        let temporal = !matches!(formula, Formula::Not(_) | Formula::And(_) | Formula::Or(_));
        if temporal && !self.temporal.contains(formula) {
            self.temporal.push(formula.clone());
        }
    }

    fn marking(&self, node: usize) -> usize {
        node >> self.temporal.len()
    }

    fn guessed(index: usize, node: usize) -> bool {
        node >> index & 1 == 1
    }

    /// Whether a formula is true of the run from here, if the guess is right.
    fn truth(&self, formula: &Formula, node: usize) -> bool {
        if let Some(holds) = self.state.get(formula) {
            return holds[self.marking(node)];
        }
        match formula {
            Formula::Not(inner) => !self.truth(inner, node),
            Formula::And(all) => all.iter().all(|it| self.truth(it, node)),
            Formula::Or(all) => all.iter().any(|it| self.truth(it, node)),
            _ => Self::guessed(self.temporal.iter().position(|it| it == formula).unwrap(), node),
        }
    }

    fn fitting(&self, node: usize) -> Vec<usize> {
        let guesses = 1 << self.temporal.len();
        let next = self.space.run_successors(self.marking(node));
        let next = next
            .into_iter()
            .flat_map(|marking| (0..guesses).map(move |guess| marking * guesses + guess));
        next.filter(|&next| (0..self.temporal.len()).all(|index| self.fits(index, node, next)))
            .collect()
    }

    fn fits(&self, index: usize, node: usize, next: usize) -> bool {
        let later = Self::guessed(index, next);
        let by_law = match &self.temporal[index] {
            Formula::Next(a) => self.truth(a, next),
            Formula::Finally(a) => self.truth(a, node) || later,
            Formula::Globally(a) => self.truth(a, node) && later,
            Formula::Until(a, b) => self.truth(b, node) || (self.truth(a, node) && later),
            other => panic!("{other:?} is not temporal"),
        };
        Self::guessed(index, node) == by_law
    }

    /// Whether nothing is outstanding here: what was guessed to come has come, what to end has
    /// ended.
    fn settled(&self, index: usize, node: usize) -> bool {
        match &self.temporal[index] {
            Formula::Finally(goal) | Formula::Until(_, goal) => {
                !Self::guessed(index, node) || self.truth(goal, node)
            }
            Formula::Globally(law) => Self::guessed(index, node) || !self.truth(law, node),
            _ => true,
        }
    }

    /// From which nodes a right run goes on for ever: the largest set of nodes from each of which,
    /// for each temporal part, a node of the set where it is settled is reached after at least one
    /// step inside of the set.
    fn right(&self) -> Vec<bool> {
        let mut right = vec![true; self.successors.len()];
        loop {
            let before = right.clone();
            right = self.coming_to(&right, &|_| true);
            for index in 0..self.temporal.len() {
                right = self.coming_to(&right, &|node| self.settled(index, node));
            }
            if right == before {
                return right;
            }
        }
    }

    /// From which nodes of a set a goal in the set is reached after at least one step inside of the
    /// set.
    fn coming_to(&self, set: &[bool], goal: &dyn Fn(usize) -> bool) -> Vec<bool> {
        let mut coming = vec![false; set.len()];
        loop {
            let mut grown = false;
            for node in (0..set.len()).rev().filter(|&it| set[it]) {
                let step = |&next: &usize| set[next] && (coming[next] || goal(next));
                if !coming[node] && self.successors[node].iter().any(step) {
                    coming[node] = true;
                    grown = true;
                }
            }
            if !grown {
                return coming;
            }
        }
    }

    fn satisfying(&self, path: &Formula) -> Vec<bool> {
        let right = self.right();
        let mut satisfying = vec![false; self.space.markings.len()];
        for node in (0..right.len()).filter(|&node| right[node] && self.truth(path, node)) {
            satisfying[self.marking(node)] = true;
        }
        satisfying
    }
}

/// Whether a formula is true of the run that goes through markings in this order, and from the last
/// one back to that at the position `back` for ever.
pub(crate) fn lasso(space: &Space<'_>, run: &[usize], back: usize, path: &Formula) -> bool {
    let next = |at: usize| if at + 1 < run.len() { at + 1 } else { back };
    truth(space, run, &next, path, 0)
}

fn truth(
    space: &Space<'_>,
    run: &[usize],
    next: &dyn Fn(usize) -> usize,
    path: &Formula,
    at: usize,
) -> bool {
    // After as many steps as there are positions every position has been passed that is ever
    // passed.
    let rest: Vec<usize> =
        std::iter::successors(Some(at), |&at| Some(next(at))).take(run.len() + 1).collect();
    let is = |path: &Formula, at: usize| truth(space, run, next, path, at);
    match path {
        path if !path.needs_run() => space.satisfying(path)[run[at]],
        Formula::Not(a) => !is(a, at),
        Formula::And(all) => all.iter().all(|it| is(it, at)),
        Formula::Or(all) => all.iter().any(|it| is(it, at)),
        Formula::Next(a) => is(a, next(at)),
        Formula::Finally(a) => rest.iter().any(|&at| is(a, at)),
        Formula::Globally(a) => rest.iter().all(|&at| is(a, at)),
        Formula::Until(a, b) => {
            let come = rest.iter().position(|&at| is(b, at));
            come.is_some_and(|come| rest[..come].iter().all(|&at| is(a, at)))
        }
        _ => panic!("{path:?} has no meaning without time"),
    }
}

#[cfg(test)]
mod tests {
    use super::{Space, lasso};
    use crate::properties::random::{Random, net, path};
    use cotama_verification::property::Formula;

    /// Whether some run of at most `longest` different positions is as a formula says.
    fn some_lasso(space: &Space<'_>, run: &mut Vec<usize>, longest: usize, path: &Formula) -> bool {
        let last = *run.last().unwrap();
        for next in space.run_successors(last) {
            let closes = |&back: &usize| run[back] == next;
            if (0..run.len()).filter(closes).any(|back| lasso(space, run, back, path)) {
                return true;
            }
            if run.len() < longest {
                run.push(next);
                let found = some_lasso(space, run, longest, path);
                run.pop();
                if found {
                    return true;
                }
            }
        }
        false
    }

    #[test]
    fn the_oracle_agrees_with_trying_all_short_runs() {
        let mut random = Random(1);
        let (mut compared, mut satisfied) = (0, 0);
        while compared < 400 {
            let net = net(&mut random);
            let space = Space::new(&net);
            let path = path(&mut random, &net, 2, false);
            if space.markings.len() > 4 || !path.needs_run() {
                continue;
            }
            compared += 1;
            let expected = some_lasso(&space, &mut vec![0], 6, &path);
            let exists = Formula::Exists(Box::new(Formula::And(vec![path.clone(), Formula::TRUE])));
            assert_eq!(
                space.satisfying(&exists)[0],
                expected,
                "{} on {net:?}",
                exists.display(&net)
            );
            satisfied += u32::from(expected);
        }
        assert!((80..320).contains(&satisfied), "{satisfied} of {compared} hold");
    }
}
