//! States that the supervisors reach in rounds, in memory without heap.

use cotama_core::units::Millis;
use cotama_models::level::{Cause, Told};
use cotama_printed::{Careful, Level, TABLES, at_rest};

/// Iterates over everything that the supervisors can be told.
pub fn all_told() -> impl Iterator<Item = Told> {
    let single = [Told::Begins, Told::Stopped, Told::GivesUp].into_iter();
    let steps = (0..TABLES.steps.len()).map(Told::Over);
    let reports = (0..TABLES.reports.len()).map(Told::Report);
    let losses = (0..TABLES.losses.len()).map(Told::Back);
    let each = (0..TABLES.sub_objectives.len())
        .flat_map(|it| [Told::Reached(it), Told::Chooses(it), Told::Done(it)]);
    let all = single.chain(steps).chain(reports).chain(losses).chain(each);
    all.filter(|it| TABLES.event(*it).is_some())
}

/// States, each once, found by a hash of their markings.
pub struct Reached<'m> {
    states: &'m mut [Level<Careful>],
    /// One more than the number of a state; zero where there is none. Open addressing.
    index: &'m mut [u32],
    count: usize,
}

impl<'m> Reached<'m> {
    /// With memory for so many states, and for at least twice as many numbers.
    pub fn new(states: &'m mut [Level<Careful>], index: &'m mut [u32]) -> Self {
        index.fill(0);
        Self { states, index, count: 0 }
    }

    /// How many states there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The state of this number.
    pub fn state(&self, number: usize) -> Option<Level<Careful>> {
        self.states.get(..self.count)?.get(number).copied()
    }

    /// Adds a state, unless it is there; false when there is no memory for it.
    pub fn add(&mut self, state: &Level<Careful>) -> bool {
        let words = state.player().marking();
        let hash = words.iter().fold(0, |hash: u64, word| {
            (hash ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29)
        });
        let start = hash as usize % self.index.len();
        let places = (start..self.index.len()).chain(0..start);
        for place in places {
            match self.index[place].checked_sub(1) {
                Some(number) if self.states[number as usize].player().marking() == words => {
                    return true;
                }
                Some(_) => {}
                None if self.count < self.states.len() => {
                    self.states[self.count] = *state;
                    self.count += 1;
                    self.index[place] = self.count as u32;
                    return true;
                }
                None => return false,
            }
        }
        false
    }

    /// Goes on from every state that there is memory for, the nearest first: a round, then nothing
    /// or one event from outside. `round` and `tell` are who does it. Returns whether there was
    /// memory for all.
    pub fn explore(
        &mut self,
        mut round: impl FnMut(&mut Level<Careful>),
        mut tell: impl FnMut(&mut Level<Careful>, Told),
    ) -> bool {
        let mut complete = self.add(&at_rest(Careful::default()));
        let mut at = 0;
        while let Some(mut after) = self.state(at) {
            at += 1;
            round(&mut after);
            complete &= self.add(&after);
            for told in all_told() {
                let mut next = after;
                tell(&mut next, told);
                complete &= self.add(&next);
            }
        }
        complete
    }
}

/// A round.
pub fn round(level: &mut Level<Careful>) {
    level.round(Millis(0), &mut ());
}

/// An event.
pub fn tell(level: &mut Level<Careful>, told: Told) {
    let _ = level.tell(Millis(0), told, Cause(0), &mut ());
}
