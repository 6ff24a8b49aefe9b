//! The marking store of a graph.

use super::bits::BitSet;
use super::goal::Goal;
use super::look::Look;
use cotama_core::net::PlaceId;
use std::fmt;

/// The markings of a graph, by their numbers: packed, as differences from the start, or as those of
/// another graph with counts beside.
pub(super) trait MarkingStore: fmt::Debug + Send + Sync {
    /// Looks at these markings.
    fn each(&self, states: &mut dyn Iterator<Item = u32>, look: &mut dyn FnMut(&Look<'_>));

    /// About how much memory they take.
    fn bytes(&self) -> u64;

    /// Returns the tokens of each place in a marking.
    fn marking(&self, state: u32) -> Vec<u32>;

    /// Returns the tokens of a place in a marking.
    fn held(&self, state: u32, place: PlaceId) -> u64;

    /// Returns the tokens of a place in each of so many markings.
    fn tokens(&self, place: PlaceId, states: u32) -> Box<dyn Iterator<Item = u32> + '_> {
        Box::new((0..states).map(move |state| self.held(state, place) as u32))
    }

    /// Returns the markings, of so many, in which the goal holds.
    fn satisfying(&self, goal: Goal<'_>, asked: Asked<'_>) -> BitSet {
        self.each_satisfying(goal, asked)
    }

    /// Returns the same, looking at the markings one by one.
    fn each_satisfying(&self, goal: Goal<'_>, asked: Asked<'_>) -> BitSet {
        let (mut set, mut state) = (BitSet::new(asked.states, false), 0);
        self.each(&mut (0..asked.states as u32), &mut |look| {
            if goal.holds(look) {
                set.insert(state);
            }
            state += 1;
        });
        set
    }
}

/// The markings of which a goal is asked.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    /// How many there are.
    pub(super) states: usize,
    /// How many threads look at them.
    pub(super) jobs: usize,
    /// Whether nothing follows a marking.
    pub(super) is_dead: &'a dyn Fn(u32) -> bool,
}
