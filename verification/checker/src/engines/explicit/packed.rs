//! All markings of a graph, packed.

use super::goal::{Few, Goal};
use super::look::Look;
use super::space::Space;
use super::view::View;
use super::{bits::BitSet, store::Asked};
use cotama_core::net::PlaceId;
use cotama_property::Marking as _;
use cotama_property::pt::Lists;
use std::thread;

/// Markings that are worth a thread of their own.
pub(super) const WORTH: usize = 1 << 14;

/// Markings of so many words each.
#[derive(Debug)]
pub(super) struct Packed {
    pub(super) space: Space,
    pub(super) words: usize,
    pub(super) markings: Vec<u64>,
    /// The needs of transitions; `None` where more than they decide.
    pub(super) needs: Option<Lists<u32>>,
}

impl Packed {
    fn of(&self, state: u32) -> &[u64] {
        let packed = &self.markings[state as usize * self.words..][..self.words];
        debug_assert_ne!(packed[0], 0, "no marking is all zeros");
        packed
    }

    /// Returns how many bytes the markings take.
    pub(super) fn bytes(&self) -> u64 {
        size_of_val(&self.markings[..]) as u64
    }

    /// Returns how many markings there are.
    pub(super) fn len(&self) -> usize {
        self.markings.len() / self.words
    }

    fn view_each(&self, states: impl Iterator<Item = u32>, mut look: impl FnMut(&[u64], &View)) {
        let (mut view, mut seen) = (self.space.enabling.view(), self.space.enabling.unseen());
        for state in states {
            let packed = self.of(state);
            self.space.enabling.look(packed, &mut view, &mut seen);
            look(packed, &view);
        }
    }

    /// Looks at markings.
    pub(super) fn each(&self, states: impl Iterator<Item = u32>, mut look: impl FnMut(&Look<'_>)) {
        self.view_each(states, |packed, view| look(&Look::packed(&self.space, packed, view)));
    }

    /// Returns the tokens of each place in a marking.
    pub(super) fn marking(&self, state: u32) -> Vec<u32> {
        let mut tokens = Vec::new();
        self.view_each(std::iter::once(state), |marking, view| {
            let word = |at: usize| {
                marking.get(at).copied().unwrap_or_else(|| view.computed[at - self.words])
            };
            let fields = &self.space.layout.fields;
            tokens = fields.iter().map(|it| it.tokens(word(it.word)) as u32).collect();
        });
        tokens
    }

    /// Returns the tokens of a place in a marking.
    #[inline]
    pub(super) fn held(&self, state: u32, place: PlaceId) -> u64 {
        Few { space: &self.space, packed: self.of(state) }.tokens(place)
    }

    /// Returns the tokens of a place in each marking.
    pub(super) fn tokens(&self, place: PlaceId) -> impl Iterator<Item = u32> {
        let (mut view, mut seen) = (self.space.enabling.view(), self.space.enabling.unseen());
        let field = &self.space.layout.fields[place.0 as usize];
        self.markings.chunks_exact(self.words).map(move |marking| {
            let word = marking.get(field.word).copied().unwrap_or_else(|| {
                self.space.enabling.look(marking, &mut view, &mut seen);
                view.computed[field.word - self.words]
            });
            field.tokens(word) as u32
        })
    }

    /// Returns the markings in which the goal holds, examined one by one.
    pub(super) fn satisfying(
        &self,
        goal: Goal<'_>,
        Asked { states, jobs, .. }: Asked<'_>,
    ) -> BitSet {
        let mut set = BitSet::new(states, false);
        let goal = goal.packed();
        let fill = |words: &mut [u64], markings: &[u64]| {
            let (mut view, mut seen) = (self.space.enabling.view(), self.space.enabling.unseen());
            for (word, markings) in words.iter_mut().zip(markings.chunks(64 * self.words)) {
                for (bit, marking) in markings.chunks_exact(self.words).enumerate() {
                    let holds = goal.holds(&self.space, marking, &mut view, &mut seen);
                    *word |= u64::from(holds) << bit;
                }
            }
        };
        let jobs = jobs.clamp(1, states.div_ceil(WORTH));
        let part = states.div_ceil(64).div_ceil(jobs).max(1);
        let markings = self.markings.chunks(part * 64 * self.words);
        let mut parts = set.words().chunks_mut(part).zip(markings);
        let first = parts.next();
        thread::scope(|scope| {
            for (words, markings) in parts {
                scope.spawn(move || fill(words, markings));
            }
            if let Some((words, markings)) = first {
                fill(words, markings);
            }
        });
        set
    }
}
