//! Automata beside a system: each looks at the marking once a round, and counts.

use cotama_core::net::PlaceId;
use cotama_property::Formula;

/// When an [`Observer`] looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Looks {
    /// When all nets have taken their turns, and what is outside has not.
    BeforeOutside,
    /// At the end of the round.
    AtEnd,
}

/// Looks at the marking once a round, and counts. It changes nothing else, so that properties about
/// rounds become properties about markings, for every engine.
///
/// State: a number from 0 on, the tokens of a place that has its name. Those that look at the
/// same time do it one after the other, in the order in which they came, before `turn.outside` or
/// `round` is marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observer {
    /// Name of the observer.
    pub name: String,
    /// When it looks.
    pub looks: Looks,
    /// The largest state.
    pub most: u32,
    /// How it goes on: the first of these that is from its state and whose formula is true; without
    /// one it stays.
    pub steps: Vec<(u32, Formula, u32)>,
}

impl Observer {
    /// Counts in how many rounds something lasts, each time that it looks: a duty that the first
    /// formula begins and the second one ends, but no sooner than a round later. It counts up to
    /// `most`, and a further beginning while one lasts counts no second time.
    ///
    /// So `bounds(name)` is the worst case in rounds, where it is less than `most`.
    pub fn lasting(name: &str, looks: Looks, begins: &Formula, ends: &Formula, most: u32) -> Self {
        let mut steps = Vec::new();
        for state in 1..=most {
            steps.push((state, Formula::Not(Box::new(ends.clone())), (state + 1).min(most)));
            steps.push((state, begins.clone(), 1));
            steps.push((state, Formula::TRUE, 0));
        }
        steps.push((0, begins.clone(), 1));
        Self { name: name.to_owned(), looks, most, steps }
    }

    /// Counts in how many rounds in a row something is so when it looks, up to `most`.
    pub fn in_a_row(name: &str, looks: Looks, what: &Formula, most: u32) -> Self {
        Self::lasting(name, looks, what, &Formula::Not(Box::new(what.clone())), most)
    }
}

/// An observer that was added, and its places.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) observer: Observer,
    pub(super) looks: PlaceId,
    pub(super) counts: PlaceId,
    /// The place marked afterwards, which would be marked next without the observer.
    pub(super) then: PlaceId,
}
