//! Markings that are met one by one, in any order: for searches that do not go level by level.

use super::enabling::Seen;
use super::index::{EMPTY, Index, hash};
use super::layout::{PRESENT, Width};
use super::look::Look;
use super::memory::Memory;
use super::space::{Space, TooNarrow};
use super::sparse::{Cursor, Sparse};
use super::view::View;
use super::{Limit, Limits};
use cotama_core::net::PlaceId;
use cotama_property::Marking;
use cotama_property::pt::Pt;

/// Markings with numbers in the order in which they are met; the initial one has number 0.
pub(crate) struct Markings<'n> {
    limits: Limits,
    pub(crate) memory: Memory,
    store: Store<'n>,
}

/// How markings are kept.
enum Store<'n> {
    Packed(Box<Packed<'n>>),
    Sparse(Box<(Sparse, Cursor)>),
}

impl<'n> Markings<'n> {
    /// The initial marking of a net.
    ///
    /// # Errors
    /// The limit that it passes.
    pub(crate) fn new(pt: &'n Pt, limits: &Limits) -> Result<Self, Limit> {
        let mut memory = Memory::new(limits.bytes);
        let store = match Packed::new(pt, limits, &mut memory) {
            Ok(it) => Store::Packed(Box::new(it)),
            Err(Limit::Words) => Store::Sparse(Box::new(Sparse::new(pt, &mut memory)?)),
            Err(limit) => return Err(limit),
        };
        Ok(Self { limits: *limits, memory, store })
    }

    /// How many markings were met.
    pub(crate) fn len(&self) -> usize {
        match &self.store {
            Store::Packed(it) => it.len(),
            Store::Sparse(it) => it.0.len(),
        }
    }

    /// Looks at a marking: its tokens, and what it enables.
    pub(crate) fn look(&mut self, marking: u32) -> Look<'_> {
        match &mut self.store {
            Store::Packed(it) => it.look(marking),
            Store::Sparse(it) => it.0.look(&mut it.1, marking),
        }
    }

    /// The marking after firing a transition that is enabled; a new one gets the next number.
    ///
    /// # Errors
    /// The limit that it passes.
    pub(crate) fn fire(&mut self, marking: u32, transition: u32) -> Result<u32, Limit> {
        let Self { limits, memory, store } = self;
        match store {
            Store::Packed(it) => it.fire(marking, transition, limits, memory),
            Store::Sparse(it) => it.0.fire(marking, transition, limits, memory),
        }
    }

    /// The marking after firing a transition that is enabled, if it was met before.
    pub(crate) fn known(&mut self, marking: u32, transition: u32) -> Option<u32> {
        match &mut self.store {
            Store::Packed(it) => it.known(marking, transition),
            Store::Sparse(it) => it.0.known(marking, transition),
        }
    }

    /// Whether time is up.
    ///
    /// # Errors
    /// [`Limit::Time`] when it is.
    pub(crate) fn check_time(&self) -> Result<(), Limit> {
        if self.limits.is_over() { Err(Limit::Time) } else { Ok(()) }
    }
}

/// Packed markings; when a place outgrows its field all are packed anew, and keep their numbers.
struct Packed<'n> {
    pt: &'n Pt,
    widths: Vec<Width>,
    space: Space,
    /// Words of a marking.
    words: usize,
    stored: Vec<u64>,
    index: Index,
    view: View,
    seen: Seen,
    after: Vec<u64>,
}

impl<'n> Packed<'n> {
    fn new(pt: &'n Pt, limits: &Limits, memory: &mut Memory) -> Result<Self, Limit> {
        let widths = Width::of(pt, limits)?;
        let space = Space::new(pt, &widths).ok_or(Limit::Words)?;
        memory.take(space.bytes())?;
        let (view, seen) = (space.enabling.view(), space.enabling.unseen());
        let mut markings = Self {
            pt,
            words: space.layout.stored,
            after: space.layout.initial.clone(),
            widths,
            space,
            stored: Vec::new(),
            index: Index::default(),
            view,
            seen,
        };
        markings.number(limits, memory)?;
        Ok(markings)
    }

    /// How many markings were met.
    fn len(&self) -> usize {
        self.stored.len() / self.words
    }

    /// Looks at a marking: its tokens, and what it enables.
    fn look(&mut self, marking: u32) -> Look<'_> {
        let packed = &self.stored[marking as usize * self.words..][..self.words];
        self.space.enabling.look(packed, &mut self.view, &mut self.seen);
        Look::packed(&self.space, packed, &self.view)
    }

    fn fire(
        &mut self,
        marking: u32,
        transition: u32,
        limits: &Limits,
        memory: &mut Memory,
    ) -> Result<u32, Limit> {
        self.add(marking, transition);
        loop {
            match self.space.check(&self.after) {
                Ok(None) => return self.number(limits, memory),
                Ok(Some(limit)) => return Err(limit),
                Err(TooNarrow(places)) => self.widen(&places, memory)?,
            }
            self.add(marking, transition);
        }
    }

    fn known(&mut self, marking: u32, transition: u32) -> Option<u32> {
        self.add(marking, transition);
        let (stored, words, after) = (&self.stored, self.words, &self.after);
        self.index.find(hash(after), |it| stored[it as usize * words..][..words] == after[..]).ok()
    }

    fn add(&mut self, marking: u32, transition: u32) {
        let from = &self.stored[marking as usize * self.words..][..self.words];
        self.space.fire(from, transition, &mut self.after);
    }

    /// The number of the marking in `after`.
    fn number(&mut self, limits: &Limits, memory: &mut Memory) -> Result<u32, Limit> {
        let (words, count) = (self.words, self.len());
        let (stored, after) = (&self.stored, &self.after);
        let found =
            self.index.find(hash(after), |it| stored[it as usize * words..][..words] == after[..]);
        let Err(slot) = found else { return found.map_err(|_| Limit::Bytes) };
        if count as u64 >= limits.states.min(EMPTY.into()) {
            return Err(Limit::States);
        }
        memory.room(&mut self.stored, words)?;
        self.stored.extend_from_slice(&self.after);
        let stored = &self.stored;
        let hash_of = |it: u32| hash(&stored[it as usize * words..][..words]);
        self.index.insert(slot, count as u32, memory, hash_of)?;
        Ok(count as u32)
    }

    /// Packs all markings anew, with these places twice as wide.
    fn widen(&mut self, places: &[usize], memory: &mut Memory) -> Result<(), Limit> {
        for &place in places {
            let bits = &mut self.widths[place].bits;
            *bits = (2 * *bits).min(u32::BITS);
        }
        let space = Space::new(self.pt, &self.widths).ok_or(Limit::Words)?;
        let (count, words) = (self.len(), space.layout.stored);
        let mut stored = Vec::new();
        memory.room(&mut stored, count * words)?;
        stored.resize(count * words, 0_u64);
        for (at, packed) in stored.chunks_exact_mut(words).enumerate() {
            let look = self.look(at as u32);
            packed[0] = PRESENT;
            for (place, field) in
                space.layout.fields.iter().enumerate().filter(|it| it.1.word < words)
            {
                packed[field.word] |= look.tokens(PlaceId(place as u32)) << field.shift;
            }
        }
        memory.give_back(&self.stored);
        (self.view, self.seen) = (space.enabling.view(), space.enabling.unseen());
        (self.words, self.stored, self.space) = (words, stored, space);
        let stored = &self.stored;
        self.index.refill(count as u32, |it| hash(&stored[it as usize * words..][..words]));
        Ok(())
    }
}
