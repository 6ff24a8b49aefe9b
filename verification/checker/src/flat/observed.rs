//! Adds observers to the rounds of a system.

use super::FlatError;
use super::branch::{Branch, Held, NO_BOUND, branches};
use super::observer::{Looks, Observer, Seen};
use super::path::{Part, Path};
use super::rounds::Rounds;
use crate::explicit::{Of, Tokens, Watch, Watching};
use cotama_core::net::PlaceId;
use cotama_property::pt::Pt;
use cotama_property::{self as property, Atom, Formula, Linear, PropertyError, Question};

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

    /// Adds an [`Observer`] that counts in how many rounds something [lasts](Observer::lasting),
    /// with its conditions as texts.
    ///
    /// # Errors
    /// When a condition is no formula about one marking, or the net would be too large.
    ///
    /// ```
    /// use cotama_models::nets::by_hand::delivery;
    /// use cotama_verification::flat::{self, Looks};
    ///
    /// let mut rounds = flat::rounds(&delivery::SYSTEM)?;
    /// rounds.watch(
    ///     "secured",
    ///     Looks::AtEnd,
    ///     ("gs.global_event.waiting", "gs.Security | gs.Safe"),
    ///     2,
    /// )?;
    /// assert!(rounds.watch("lost", Looks::AtEnd, ("gs.Lost", "gs.Safe"), 2).is_err());
    /// # Ok::<(), cotama_verification::flat::FlatError>(())
    /// ```
    pub fn watch(
        &mut self,
        name: &str,
        looks: Looks,
        (begins, ends): (&str, &str),
        most: u32,
    ) -> Result<(), FlatError> {
        let condition = |text| {
            let error =
                |error| FlatError::Text { observer: name.to_owned(), error: Box::new(error) };
            self.condition(text).map_err(error)
        };
        let observer = Observer::lasting(name, looks, &condition(begins)?, &condition(ends)?, most);
        self.observe(&observer)
    }

    /// Adds an observer.
    ///
    /// # Errors
    /// When it looks at more than sums of tokens of bounded places, or the net would be too large.
    pub fn observe(&mut self, observer: &Observer) -> Result<(), FlatError> {
        let unsuited = || FlatError::Condition { observer: observer.name.clone() };
        let is_sound = |(from, when, to): &(u32, Formula, u32)| {
            *from.max(to) <= observer.most && self.can_be_seen(when)
        };
        if !observer.steps.iter().all(is_sound) {
            return Err(unsuited());
        }
        let looks = self.place(&format!("{}.looks", observer.name), "The observer looks.", 0, 1);
        let place = self.place(&observer.name, "What the observer counts.", 0, observer.most);
        let then = match observer.looks {
            Looks::BeforeOutside => self.outside,
            Looks::AtEnd => self.round,
        };
        for path in &mut self.paths {
            if path.change.get(&then) == Some(&1) {
                path.change.remove(&then);
                path.change.insert(looks, 1);
            }
        }
        let known = self.known.clone();
        for from in 0..=observer.most {
            let tokens = i64::from(from);
            let held = Held::from([(place, (tokens, tokens))]);
            let step = |branch: &mut Branch<'_>| {
                let mut steps = observer.steps.iter().filter(|it| it.0 == from);
                let next = steps.find(|it| holds(branch, &it.1)).map_or(from, |it| it.2);
                branch.add(place, i64::from(next) - tokens);
                Ok(next)
            };
            branches(&known, &held, step, |branch, next| {
                let name = format!("{}: {next}", observer.name);
                let path = Path::new(Part::Between, name, looks, then, branch);
                self.push(Path { held: known.essential(&path.held), ..path })
            })?;
        }
        self.watches.push(Seen { observer: observer.clone(), looks, counts: place, then });
        Ok(())
    }

    /// How the net follows from the net without observers.
    pub fn watching(&self) -> Watching {
        let of = |place: PlaceId| {
            let at = |of: fn(&Seen) -> PlaceId| self.watches.iter().position(|it| of(it) == place);
            match (at(|it| it.looks), at(|it| it.counts), at(|it| it.then)) {
                (Some(watch), ..) => Of::Looks(watch),
                (_, Some(watch), _) => Of::Counts(watch),
                (.., Some(_)) => Of::Turn(place),
                _ => Of::Place(place),
            }
        };
        let own = (0..self.draft.places.len() as u32)
            .map(|it| Tokens { of: of(PlaceId(it)), lacks: None });
        let complement = |place: PlaceId| {
            let lacks = Some(self.draft.places[place.0 as usize].bound);
            Tokens { of: of(place), lacks }
        };
        let watch = |it: &Seen| Watch { then: it.then, steps: it.observer.steps.clone() };
        Watching {
            places: own.chain(self.wanted().into_iter().map(complement)).collect(),
            watches: self.watches.iter().map(watch).collect(),
        }
    }

    /// Whether it is about one marking and compares sums of tokens of bounded places.
    fn can_be_seen(&self, formula: &Formula) -> bool {
        let bounded =
            |sum: &Linear| sum.weights.iter().all(|&(place, _)| self.known.bound(place) < NO_BOUND);
        let seen = |it: &Formula| match it {
            Formula::Atom(atom) => matches!(atom, Atom::AtMost(sum) if bounded(sum)),
            _ => true,
        };
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
        let (mut least, mut most, mut open) =
            (i128::from(sum.constant), i128::from(sum.constant), None);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explicit::{Goal, Graph, Limits};
    use crate::flat::rounds;
    use cotama_core::{net, system};
    use std::sync::Arc;

    net! {
        mod guest {
            places { Out: 1, In }
            events { come, opened, leave }
            outputs { ring }
            transitions {
                ring on come: Out => Out emit ring;
                enter on opened: Out => In;
                leave on leave: In => Out;
            }
            ignore { come in In; opened in In; leave in Out; }
        }
    }
    net! {
        mod door {
            places { Shut: 1, Open }
            events { bell, wind }
            outputs { click }
            transitions {
                open on bell: Shut => Open emit click;
                shut on wind: Open => Shut;
            }
            ignore { bell in Open; wind in Shut; }
        }
    }
    system! {
        mod house {
            nets { guest: guest, door: door }
            links { guest.ring => door.bell mail 2; door.click => guest.opened mail 1; }
        }
    }

    /// Observers that look at marks of the round, at what is not there, and at each other.
    const WATCHES: [(&str, Looks, (&str, &str), u32); 5] = [
        ("open", Looks::AtEnd, ("door.Open", "!door.Open"), 3),
        ("rung", Looks::BeforeOutside, ("door.bell.waiting >= 1", "guest.In"), 2),
        ("both", Looks::AtEnd, ("open >= 2 & rung <= 1", "open = 0 | round"), 4),
        ("turn", Looks::BeforeOutside, ("!turn.outside & !(guest.In & door.Open)", "both = 4"), 1),
        ("mail", Looks::AtEnd, ("door.bell.waiting <= 1 & both.looks = 0", "rung = 2"), 2),
    ];

    /// Each property, of the graph that follows from the other one and of the graph by itself.
    #[test]
    fn the_graph_with_watches_follows_from_the_graph_without() {
        let plain = rounds(&house::SYSTEM).unwrap();
        let base = Pt::from(&plain.net().unwrap().view().net());
        let base = Arc::new(Graph::new(&base, &Limits::default(), &|_| ()).unwrap());
        for few in 0..=WATCHES.len() {
            let mut watched = plain.clone();
            for &(name, looks, (begins, ends), most) in &WATCHES[..few] {
                watched.watch(name, looks, (begins, ends), most).unwrap();
            }
            let pt = Pt::from(&watched.net().unwrap().view().net());
            let watching = watched.watching();
            let made = Graph::watched(&base, (&pt, &watching), &Limits::default(), &|_| ());
            let (made, alone) =
                (made.unwrap().unwrap(), Graph::new(&pt, &Limits::default(), &|_| ()).unwrap());
            assert_eq!((made.states(), made.arcs()), (alone.states(), alone.arcs()));
            assert_eq!(made.liveness(), alone.liveness());
            for state in 0..alone.states() as u32 {
                assert_eq!(made.successors(state), alone.successors(state));
                assert_eq!(made.marking(state), alone.marking(state));
                assert_eq!(made.transitions(state), alone.transitions(state));
            }
            for place in (0..pt.places.len() as u32).map(PlaceId) {
                let tokens = [&made, &alone].map(|it| it.tokens(place).collect::<Vec<_>>());
                assert_eq!(tokens[0], tokens[1]);
            }
            let atoms = (0..pt.transitions.len() as u32)
                .map(|it| Atom::Fireable(vec![cotama_core::net::TransitionId(it)]))
                .chain(
                    (0..pt.places.len() as u32).map(|it| Atom::AtMost(Linear::marked(PlaceId(it)))),
                )
                .chain([Atom::Deadlock])
                .chain((1..pt.places.len() as u32).map(|it| {
                    let weights = vec![(PlaceId(it - 1), 2), (PlaceId(it), -1)];
                    Atom::AtMost(Linear { constant: 0, weights })
                }));
            for atom in atoms {
                let formula = Formula::Not(Formula::Atom(atom).into());
                let goal = Goal::new(&formula).unwrap();
                assert_eq!(made.satisfying(goal, 1), alone.satisfying(goal, 1), "{formula:?}");
                assert_eq!(made.first(goal), alone.first(goal));
            }
        }
    }
}
