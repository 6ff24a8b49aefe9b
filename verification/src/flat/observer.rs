//! What remembers something from round to round.

use super::FlatError;
use super::branch::{Branch, Held, NO_BOUND, Sum, branches};
use super::rounds::{Part, Path, Rounds};
use crate::property::{self, Atom, Formula, Linear, PropertyError, Question};
use crate::pt::Pt;
use cotama_core::net::PlaceId;

/// Looks at the marking at the end of each round, and goes from one of its states to another. It changes nothing else, so that
/// properties about rounds become properties about markings, for every engine.
///
/// Each state becomes a place, `observer.state`. Observers look one after the other, in the order in which they came, before `round` is
/// marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observer {
    /// Its name.
    pub name: String,
    /// The names of its states; it starts in the first one.
    pub states: Vec<String>,
    /// How it goes on: the first of these that is from its state and whose formula is true, by positions in `states`; without one it
    /// stays.
    pub steps: Vec<(usize, Formula, usize)>,
}

impl Observer {
    /// Counts at the ends of how many rounds something lasts: a duty that the first formula begins and the second one ends, but no
    /// sooner than a round later.
    ///
    /// Its states are `none`, `1` and so on to this many rounds, and `late` after that. A further beginning while one lasts counts no
    /// second time.
    pub fn lasting(name: &str, begins: &Formula, ends: &Formula, rounds: usize) -> Self {
        let mut states = vec!["none".to_owned()];
        states.extend((1..=rounds).map(|it| it.to_string()));
        states.push("late".to_owned());
        let mut steps = Vec::new();
        for state in 1..states.len() {
            let next = (state + 1).min(rounds + 1);
            steps.push((state, Formula::Not(Box::new(ends.clone())), next));
            steps.push((state, begins.clone(), 1));
            steps.push((state, Formula::TRUE, 0));
        }
        steps.push((0, begins.clone(), 1));
        Self { name: name.to_owned(), states, steps }
    }

    /// Counts how many rounds in a row end with something.
    pub fn in_a_row(name: &str, what: &Formula, rounds: usize) -> Self {
        Self::lasting(name, what, &Formula::Not(Box::new(what.clone())), rounds)
    }

    /// A question: the largest position of a state that is ever reached. Of [`Observer::lasting`], at the ends of how many rounds it
    /// lasts at most; one more than was asked for says that it lasts longer.
    pub fn farthest(&self) -> String {
        let state = |(name, at): (&String, usize)| format!("{at} * \"{}.{name}\"", self.name);
        let sum: Vec<_> = self.states.iter().zip(0..).skip(1).map(state).collect();
        format!("bounds({})", sum.join(" + "))
    }
}

impl Rounds {
    /// A formula about one marking that speaks of places by their names; for an [`Observer`].
    ///
    /// # Errors
    /// When it is none, or names no place.
    pub fn condition(&self, text: &str) -> Result<Formula, PropertyError> {
        let pt = Pt::from(&self.draft.view().net());
        match property::parse(text, &pt)?.question {
            Question::Formula(formula) => Ok(formula),
            // A formula is what `observe` refuses with a better reason.
            _ => Ok(Formula::Atom(Atom::Deadlock)),
        }
    }

    /// Adds an observer.
    ///
    /// # Errors
    /// When it looks at more than sums of tokens of bounded places, or the net would be too large.
    pub fn observe(&mut self, observer: &Observer) -> Result<(), FlatError> {
        let unsuited = || FlatError::Condition { observer: observer.name.clone() };
        let count = observer.states.len();
        for (from, when, to) in &observer.steps {
            if *from >= count || *to >= count || !self.can_be_seen(when) {
                return Err(unsuited());
            }
        }
        let looks = self.place(&format!("{}.looks", observer.name), "The observer looks.", 0);
        let places = observer.states.iter().zip(0..).map(|(state, at)| {
            self.place(&format!("{}.{state}", observer.name), "A state of the observer.", u32::from(at == 0))
        });
        let places: Vec<PlaceId> = places.collect();
        for path in &mut self.paths {
            if path.change.get(&self.round) == Some(&1) {
                path.change.remove(&self.round);
                path.change.insert(looks, 1);
            }
        }
        self.known.remember(Sum { weights: places.iter().map(|&it| (it, 1)).collect(), total: 1 });
        let known = self.known.clone();
        for (from, &place) in places.iter().enumerate() {
            let ways = branches(&known, &Held::from([(place, (1, 1))]), |branch| {
                let steps = observer.steps.iter().filter(|it| it.0 == from);
                let next = steps.into_iter().find(|it| holds(branch, &it.1)).map_or(from, |it| it.2);
                if next != from {
                    branch.add(place, -1);
                    branch.add(places[next], 1);
                }
                Ok(next)
            });
            for (mut branch, next) in ways? {
                let name = format!("{}: {}", observer.name, observer.states[next]);
                branch.held.insert(place, (1, 1));
                let mut path = Path::new(Part::Between, name, looks, self.round, &branch);
                path.held.insert(place, (1, 1));
                self.push(path)?;
            }
        }
        Ok(())
    }

    /// Whether it is about one marking and compares sums of tokens of bounded places.
    fn can_be_seen(&self, formula: &Formula) -> bool {
        let bounded = |sum: &Linear| sum.weights.iter().all(|&(place, _)| self.known.bound(place) < NO_BOUND);
        let seen = |it: &Formula| !matches!(it, Formula::Atom(atom) if !matches!(atom, Atom::AtMost(sum) if bounded(sum)));
        formula.is_state() && !formula.any(&|it| !seen(it))
    }
}

/// Whether a formula about one marking is true by now.
fn holds(branch: &mut Branch<'_>, formula: &Formula) -> bool {
    match formula {
        Formula::Not(inner) => !holds(branch, inner),
        Formula::And(all) => all.iter().all(|it| holds(branch, it)),
        Formula::Or(all) => all.iter().any(|it| holds(branch, it)),
        Formula::Atom(Atom::AtMost(sum)) => at_most(branch, sum),
        _ => false,
    }
}

fn at_most(branch: &mut Branch<'_>, sum: &Linear) -> bool {
    loop {
        let (mut least, mut most, mut open) = (i128::from(sum.constant), i128::from(sum.constant), None);
        for &(place, weight) in &sum.weights {
            let (low, high) = branch.range(place);
            let [low_part, high_part] = [low, high].map(|it| i128::from(it) * i128::from(weight));
            least += low_part.min(high_part);
            most += low_part.max(high_part);
            if low < high {
                open.get_or_insert((place, low + 1));
            }
        }
        match open {
            Some((place, tokens)) if least <= 0 && most > 0 => {
                branch.holds(place, tokens);
            }
            _ => return most <= 0,
        }
    }
}
