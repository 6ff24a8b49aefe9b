//! A set of states, a bit for each.

use std::ops::Index;

/// For each state whether it is in a set: a bit each.
///
/// ```
/// use cotama_checker::explicit::BitSet;
/// let mut even = BitSet::new(3, false);
/// even.insert(0);
/// even.insert(2);
/// assert_eq!((even[1], even[2], even.ones().collect::<Vec<_>>()), (false, true, vec![0, 2]));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BitSet {
    words: Vec<u64>,
    len: usize,
}

impl BitSet {
    /// So many states, all or none of them in the set.
    pub fn new(len: usize, all: bool) -> Self {
        let mut set = Self { words: vec![if all { u64::MAX } else { 0 }; len.div_ceil(64)], len };
        set.trim();
        set
    }

    /// So many states, with these bits of those in the set.
    pub(super) fn from_words(words: Vec<u64>, len: usize) -> Self {
        let mut set = Self { words, len };
        set.words.resize(len.div_ceil(64), 0);
        set.trim();
        set
    }

    /// How many bytes a set of so many states takes.
    pub const fn bytes(len: usize) -> u64 {
        8 * len.div_ceil(64) as u64
    }

    /// How many states there are, in the set or not.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no state at all.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Whether a state is in the set; `false` beyond the last.
    #[inline]
    pub fn has(&self, state: u32) -> bool {
        self.words.get(state as usize / 64).is_some_and(|it| it >> (state % 64) & 1 == 1)
    }

    /// Adds a state.
    ///
    /// # Panics
    /// When there is no such state.
    #[inline]
    pub fn insert(&mut self, state: u32) {
        debug_assert!((state as usize) < self.len, "a state of the set's graph");
        self.words[state as usize / 64] |= 1 << (state % 64);
    }

    /// Keeps the states that are in the other set as well.
    pub fn and(&mut self, other: &Self) {
        debug_assert_eq!(self.len, other.len, "sets of the same states");
        self.words.iter_mut().zip(&other.words).for_each(|(it, other)| *it &= other);
    }

    /// Adds the states of the other set.
    pub fn or(&mut self, other: &Self) {
        debug_assert_eq!(self.len, other.len, "sets of the same states");
        self.words.iter_mut().zip(&other.words).for_each(|(it, other)| *it |= other);
    }

    /// The states that are not in the set.
    #[must_use]
    pub fn complement(&self) -> Self {
        let words = self.words.iter().map(|it| !it).collect();
        let mut set = Self { words, len: self.len };
        set.trim();
        set
    }

    /// The states of the set in their order.
    pub fn ones(&self) -> impl Iterator<Item = u32> + '_ {
        self.words
            .iter()
            .enumerate()
            .flat_map(|(at, &word)| super::view::Bits(word).map(move |bit| 64 * at as u32 + bit))
    }

    /// For each state whether it is in the set.
    pub fn iter(&self) -> impl Iterator<Item = bool> + '_ {
        (0..self.len as u32).map(|it| self.has(it))
    }

    /// The words of the bits, for threads that fill them one by one.
    pub(super) fn words(&mut self) -> &mut [u64] {
        &mut self.words
    }

    /// Takes away bits beyond the last state.
    fn trim(&mut self) {
        let rest = self.len % 64;
        if let Some(last) = self.words.last_mut().filter(|_| rest > 0) {
            *last &= (1 << rest) - 1;
        }
    }
}

/// Whether a state is in the set.
impl Index<usize> for BitSet {
    type Output = bool;

    fn index(&self, state: usize) -> &bool {
        if u32::try_from(state).is_ok_and(|it| self.has(it)) { &true } else { &false }
    }
}
