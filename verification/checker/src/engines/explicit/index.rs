//! A hash table of numbers: the items stand elsewhere.

use super::Limit;
use super::memory::Memory;

/// Marks a free slot.
pub(super) const EMPTY: u32 = u32::MAX;

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
        debug_assert_eq!(number as usize + 1, self.used, "numbers come in their order");
        debug_assert!(self.slots.get(slot).is_none_or(|it| *it == EMPTY), "the slot is free");
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

    pub(super) fn refill(&mut self, count: u32, hash_of: impl Fn(u32) -> u64) {
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
