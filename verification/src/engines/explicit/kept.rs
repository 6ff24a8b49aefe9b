//! The markings of a graph, packed or as what differs from the start.

use super::bits::BitSet;
use super::goal::{Few, Goal};
use super::markings::Look;
use super::space::Space;
use super::sparse::{Cursor, Sparse};
use super::view::View;
use super::watched::Watched;
use crate::property::Marking;
use crate::pt::Lists;
use cotama_core::net::PlaceId;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Markings that are worth a thread of their own.
pub(super) const WORTH: usize = 1 << 14;

/// How markings are kept.
#[derive(Debug)]
pub(super) enum Kept {
    Packed(Box<Packed>),
    Sparse(Box<Sparse>, Box<Mutex<Cursor>>),
    Watched(Box<Watched>),
}

/// Markings of so many words each.
#[derive(Debug)]
pub(super) struct Packed {
    pub(super) space: Space,
    pub(super) words: usize,
    pub(super) markings: Vec<u64>,
    /// What transitions need.
    pub(super) needs: Lists<u32>,
}

impl Packed {
    fn of(&self, state: u32) -> &[u64] {
        &self.markings[state as usize * self.words..][..self.words]
    }

    fn each(&self, states: impl Iterator<Item = u32>, mut look: impl FnMut(&[u64], &View)) {
        let (mut view, mut seen) = (self.space.enabling.view(), self.space.enabling.unseen());
        for state in states {
            let packed = self.of(state);
            self.space.enabling.look(packed, &mut view, &mut seen);
            look(packed, &view);
        }
    }
}

impl Kept {
    /// Looks at markings.
    pub(super) fn each(&self, states: impl Iterator<Item = u32>, mut look: impl FnMut(&Look<'_>)) {
        match self {
            Self::Packed(it) => {
                it.each(states, |packed, view| look(&Look::packed(&it.space, packed, view)));
            }
            Self::Sparse(it, cursor) => {
                let mut cursor = cursor.lock().unwrap_or_else(PoisonError::into_inner);
                states.for_each(|state| look(&it.look(&mut cursor, state)));
            }
            Self::Watched(it) => it.each(states, look),
        }
    }

    /// About how much memory they take.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Packed(it) => size_of_val(&it.markings[..]) as u64,
            Self::Sparse(it, _) => it.bytes(),
            Self::Watched(it) => it.bytes(),
        }
    }

    pub(super) fn marking(&self, state: u32) -> Vec<u32> {
        let it = match self {
            Kept::Packed(it) => it,
            Kept::Sparse(it, _) => return it.marking(state),
            Kept::Watched(it) => return it.marking(state),
        };
        let mut tokens = Vec::new();
        it.each(std::iter::once(state), |marking, view| {
            let word = |at: usize| {
                marking.get(at).copied().unwrap_or_else(|| view.computed[at - it.words])
            };
            let fields = &it.space.layout.fields;
            tokens = fields.iter().map(|it| it.tokens(word(it.word)) as u32).collect();
        });
        tokens
    }

    /// The tokens of a place in a marking.
    #[inline]
    pub(super) fn held(&self, state: u32, place: PlaceId) -> u64 {
        match self {
            Self::Packed(it) => Few { space: &it.space, packed: it.of(state) }.tokens(place),
            Self::Sparse(it, _) => it.tokens(state, place.0).into(),
            Self::Watched(it) => it.tokens(state, place),
        }
    }

    /// The tokens of a place in each of so many markings.
    pub(super) fn tokens(&self, place: PlaceId, states: u32) -> impl Iterator<Item = u32> {
        let Kept::Packed(it) = self else {
            return Either::Other((0..states).map(move |state| self.held(state, place) as u32));
        };
        let (mut view, mut seen) = (it.space.enabling.view(), it.space.enabling.unseen());
        let field = &it.space.layout.fields[place.0 as usize];
        Either::Packed(it.markings.chunks_exact(it.words).map(move |marking| {
            let word = marking.get(field.word).copied().unwrap_or_else(|| {
                it.space.enabling.look(marking, &mut view, &mut seen);
                view.computed[field.word - it.words]
            });
            field.tokens(word) as u32
        }))
    }

    /// Those of so many markings in which the goal holds, looked at by so many threads.
    pub(super) fn satisfying(&self, goal: Goal<'_>, states: usize, jobs: usize) -> BitSet {
        if let Self::Watched(it) = self
            && let Some(set) = it.satisfying(goal, jobs)
        {
            return set;
        }
        let mut set = BitSet::new(states, false);
        let Self::Packed(it) = self else {
            let mut state = 0;
            self.each(0..states as u32, |look| {
                if goal.holds(look) {
                    set.insert(state);
                }
                state += 1;
            });
            return set;
        };
        let goal = goal.packed();
        let fill = |words: &mut [u64], markings: &[u64]| {
            let (mut view, mut seen) = (it.space.enabling.view(), it.space.enabling.unseen());
            for (word, markings) in words.iter_mut().zip(markings.chunks(64 * it.words)) {
                for (bit, marking) in markings.chunks_exact(it.words).enumerate() {
                    let holds = goal.holds(&it.space, marking, &mut view, &mut seen);
                    *word |= u64::from(holds) << bit;
                }
            }
        };
        let jobs = jobs.clamp(1, states.div_ceil(WORTH));
        let part = states.div_ceil(64).div_ceil(jobs).max(1);
        let mut parts = set.words().chunks_mut(part).zip(it.markings.chunks(part * 64 * it.words));
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

/// One of two iterators.
enum Either<A, B> {
    Packed(A),
    Other(B),
}

impl<T, A: Iterator<Item = T>, B: Iterator<Item = T>> Iterator for Either<A, B> {
    type Item = T;

    fn next(&mut self) -> Option<T> {
        match self {
            Self::Packed(it) => it.next(),
            Self::Other(it) => it.next(),
        }
    }
}
