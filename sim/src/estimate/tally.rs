//! Counts over runs.

use super::path::{Asked, Judged};
use cotama_core::net::{PlaceId, TransitionId};
use std::fmt;

/// The results of many runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawn {
    /// How many runs there were.
    pub runs: u64,
    /// How many transitions fired in all of them.
    pub steps: u64,
    /// One a question, in their order.
    pub tallies: Vec<Tally>,
}

/// The counts of one question.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// How many runs were as the property says, within their steps.
    pub holding: u64,
    /// Number of runs that were not decided when their steps were used up.
    pub open: u64,
    /// The shortest run that is surely as the property says; of several the first.
    pub shortest_holding: Option<Witness>,
    /// The shortest run that surely is not.
    pub shortest_broken: Option<Witness>,
}

/// A run, and how many steps of it decide a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Witness {
    /// Number of steps.
    pub steps: u64,
    /// Number of the run, from 0.
    pub run: u64,
}

/// A place would hold more tokens than can be counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overflow {
    /// The number of the run.
    pub run: u64,
    /// The transition.
    pub transition: TransitionId,
    /// The place.
    pub place: PlaceId,
}

impl fmt::Display for Overflow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "in run {} a place comes to more than {} tokens", self.run, u32::MAX)
    }
}

impl std::error::Error for Overflow {}

impl Drawn {
    pub(super) fn none(questions: usize) -> Self {
        Self { runs: 0, steps: 0, tallies: vec![Tally::default(); questions] }
    }

    /// Adds what came of other runs.
    pub(super) fn add(&mut self, other: &Self) {
        let shorter = |a: Option<Witness>, b: Option<Witness>| a.into_iter().chain(b).min();
        self.runs += other.runs;
        self.steps += other.steps;
        for (it, more) in self.tallies.iter_mut().zip(&other.tallies) {
            it.holding += more.holding;
            it.open += more.open;
            it.shortest_holding = shorter(it.shortest_holding, more.shortest_holding);
            it.shortest_broken = shorter(it.shortest_broken, more.shortest_broken);
        }
    }
}

impl Tally {
    /// Counts what a run came to.
    pub(super) fn add(&mut self, asked: &Asked<'_>, judged: Judged, seen: Witness) {
        let shorter = |it: Option<Witness>| Some(it.map_or(seen, |it| it.min(seen)));
        match judged {
            Judged::Holds => {
                self.holding += 1;
                self.shortest_holding = shorter(self.shortest_holding);
            }
            Judged::Broken => self.shortest_broken = shorter(self.shortest_broken),
            Judged::Open => {
                self.open += 1;
                self.holding += u64::from(asked.holds_so_far());
            }
        }
    }
}
