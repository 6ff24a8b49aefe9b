//! Markings that are met one by one, in any order: for searches that do not go level by level.

use super::enabling::Seen;
use super::layout::{PRESENT, Width};
use super::space::{Space, TooNarrow};
use super::sparse::{Cursor, Sparse};
use super::view::View;
use super::{Limit, Limits};
use crate::property::Marking;
use crate::pt::Pt;
use cotama_core::net::PlaceId;

/// No number.
const EMPTY: u32 = u32::MAX;

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
    /// For each transition what firing it adds.
    deltas: Vec<u64>,
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
            deltas: deltas(pt, &space),
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
        let delta = &self.deltas[transition as usize * self.words..][..self.words];
        self.after.clear();
        self.after.extend(from.iter().zip(delta).map(|(word, delta)| word.wrapping_add(*delta)));
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
        (self.deltas, self.words, self.stored, self.space) =
            (deltas(self.pt, &space), words, stored, space);
        let stored = &self.stored;
        self.index.refill(count as u32, |it| hash(&stored[it as usize * words..][..words]));
        Ok(())
    }
}

fn deltas(pt: &Pt, space: &Space) -> Vec<u64> {
    (0..pt.transitions.len() as u32).flat_map(|it| space.layout.delta(pt, it)).collect()
}

/// A marking as it is looked at.
#[derive(Clone, Copy)]
pub(crate) struct Look<'m> {
    tokens: Held<'m>,
    pub(super) view: &'m View,
}

/// Where its tokens are.
#[derive(Clone, Copy)]
enum Held<'m> {
    Packed(&'m Space, &'m [u64]),
    Plain(&'m [u32]),
}

impl<'m> Look<'m> {
    pub(super) fn packed(space: &'m Space, packed: &'m [u64], view: &'m View) -> Self {
        Self { tokens: Held::Packed(space, packed), view }
    }

    pub(super) fn plain(tokens: &'m [u32], view: &'m View) -> Self {
        Self { tokens: Held::Plain(tokens), view }
    }
}

impl Look<'_> {
    /// The transitions that are enabled, in their order.
    pub(crate) fn transitions(&self) -> impl Iterator<Item = u32> + '_ {
        self.view.transitions()
    }

    /// Whether a transition is enabled.
    pub(crate) fn enables(&self, transition: u32) -> bool {
        self.view
            .enabled
            .get(transition as usize / 64)
            .is_some_and(|it| it >> (transition % 64) & 1 == 1)
    }
}

impl Marking for Look<'_> {
    #[inline]
    fn tokens(&self, place: PlaceId) -> u64 {
        let at = place.0 as usize;
        match self.tokens {
            Held::Plain(tokens) => tokens.get(at).copied().unwrap_or(0).into(),
            Held::Packed(space, packed) => space.layout.fields.get(at).map_or(0, |field| {
                let at = field.word;
                field.tokens(
                    packed
                        .get(at)
                        .copied()
                        .unwrap_or_else(|| self.view.computed[at - packed.len()]),
                )
            }),
        }
    }
}

/// Bytes that are taken, and may be.
#[derive(Debug)]
pub(crate) struct Memory {
    used: u64,
    most: u64,
}

impl Memory {
    /// Nothing is taken of so many bytes.
    pub(crate) const fn new(most: u64) -> Self {
        Self { used: 0, most }
    }

    /// Takes so many bytes.
    ///
    /// # Errors
    /// [`Limit::Bytes`] when that is too much.
    pub(crate) fn take(&mut self, bytes: u64) -> Result<(), Limit> {
        self.used += bytes;
        if self.used > self.most { Err(Limit::Bytes) } else { Ok(()) }
    }

    /// Gives back so many bytes.
    pub(crate) fn release(&mut self, bytes: u64) {
        self.used -= self.used.min(bytes);
    }

    /// Makes room for so many more items in a list.
    ///
    /// # Errors
    /// [`Limit::Bytes`] when that is too much.
    pub(crate) fn room<T>(&mut self, list: &mut Vec<T>, more: usize) -> Result<(), Limit> {
        let (before, needed) = (list.capacity(), list.len() + more);
        if needed <= before {
            return Ok(());
        }
        let room = needed.max(before + before / 2).max(16);
        self.used += ((room - before) * size_of::<T>()) as u64;
        if self.used > self.most {
            return Err(Limit::Bytes);
        }
        list.try_reserve_exact(room - list.len()).map_err(|_| Limit::Bytes)
    }

    /// Makes a list so long.
    ///
    /// # Errors
    /// [`Limit::Bytes`] when that is too much.
    pub(crate) fn extend<T: Clone>(
        &mut self,
        list: &mut Vec<T>,
        len: usize,
        with: T,
    ) -> Result<(), Limit> {
        self.room(list, len.saturating_sub(list.len()))?;
        list.resize(len, with);
        Ok(())
    }

    /// How many are taken.
    pub(super) const fn used(&self) -> u64 {
        self.used
    }

    fn give_back<T>(&mut self, list: &Vec<T>) {
        self.used -= self.used.min((list.capacity() * size_of::<T>()) as u64);
    }
}

/// Numbers of items, each where the hash of the item leads to or after that with none empty
/// between.
#[derive(Debug, Default)]
pub(crate) struct Index {
    slots: Vec<u32>,
    used: usize,
}

impl Index {
    /// The number of an item; or else the slot where it belongs.
    pub(crate) fn find(&self, hash: u64, is_same: impl Fn(u32) -> bool) -> Result<u32, usize> {
        if self.slots.is_empty() {
            return Err(0);
        }
        let mut slot = self.home(hash);
        loop {
            match self.slots[slot] {
                EMPTY => return Err(slot),
                number if is_same(number) => return Ok(number),
                _ => slot = if slot + 1 == self.slots.len() { 0 } else { slot + 1 },
            }
        }
    }

    /// Puts a number into a slot that was found for it; numbers are given in their order.
    ///
    /// # Errors
    /// [`Limit::Bytes`] when it has to grow, and cannot.
    pub(crate) fn insert(
        &mut self,
        slot: usize,
        number: u32,
        memory: &mut Memory,
        hash_of: impl Fn(u32) -> u64,
    ) -> Result<(), Limit> {
        self.used += 1;
        if 4 * self.used <= 3 * self.slots.len() {
            self.slots[slot] = number;
            return Ok(());
        }
        let slots = (2 * self.slots.len()).max(64);
        memory.give_back(&std::mem::take(&mut self.slots));
        memory.room(&mut self.slots, slots)?;
        self.slots.resize(slots, EMPTY);
        self.refill(number + 1, hash_of);
        Ok(())
    }

    fn refill(&mut self, count: u32, hash_of: impl Fn(u32) -> u64) {
        self.slots.fill(EMPTY);
        for number in 0..count {
            if let Err(slot) = self.find(hash_of(number), |_| false) {
                self.slots[slot] = number;
            }
        }
    }

    fn home(&self, hash: u64) -> usize {
        ((u128::from(hash) * self.slots.len() as u128) >> 64) as usize
    }
}

/// A hash whose upper bits are well mixed.
#[inline]
pub(crate) fn hash(words: &[u64]) -> u64 {
    words.iter().fold(0, |hash, word| {
        let product = u128::from(hash ^ word ^ 0x2545_f491_4f6c_dd1d) * 0x9e37_79b9_7f4a_7c15;
        (product >> 64) as u64 ^ product as u64
    })
}
