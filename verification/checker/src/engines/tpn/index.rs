//! Numbering things by what they are.

/// A hash table of numbers: what they stand for is stored elsewhere.
#[derive(Clone, Debug)]
pub(super) struct Index {
    /// Hash and number plus one; a number of zero is a free slot. The length is a power of two.
    slots: Vec<(u32, u32)>,
    used: usize,
}

impl Index {
    pub(super) fn new() -> Self {
        Self { slots: vec![(0, 0); 64], used: 0 }
    }

    /// The number of a thing with this hash, which `is` knows; or `None` when it is new, and now
    /// has number `next`.
    pub(super) fn find_or_insert(
        &mut self,
        hash: u64,
        next: u32,
        is: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        if self.used * 2 >= self.slots.len() {
            self.grow();
        }
        let mask = self.slots.len() - 1;
        let short = (hash >> 32) as u32;
        let mut at = short as usize & mask;
        loop {
            match self.slots[at] {
                (_, 0) => break,
                (of, number) if of == short && is(number - 1) => return Some(number - 1),
                _ => at = (at + 1) & mask,
            }
        }
        self.slots[at] = (short, next + 1);
        self.used += 1;
        None
    }

    fn grow(&mut self) {
        let larger = vec![(0, 0); self.slots.len() * 2];
        let mask = larger.len() - 1;
        for slot in std::mem::replace(&mut self.slots, larger) {
            let mut at = slot.0 as usize & mask;
            while slot.1 != 0 && self.slots[at].1 != 0 {
                at = (at + 1) & mask;
            }
            if slot.1 != 0 {
                self.slots[at] = slot;
            }
        }
    }

    /// How many bytes it takes, or will take at most while it is made larger for the next thing.
    pub(super) fn bytes(&self) -> usize {
        let tables = if (self.used + 1) * 2 >= self.slots.len() { 3 } else { 1 };
        tables * self.slots.len() * size_of::<(u32, u32)>()
    }
}

/// Makes room for so many more items, and for a sixteenth of what is there: a list that grows
/// twofold would take up to twice what is in it.
pub(super) fn room<T>(list: &mut Vec<T>, more: usize) {
    if list.capacity() - list.len() < more {
        list.reserve_exact(more + list.len() / 16 + 64);
    }
}

/// How many bytes a list takes, used or not.
pub(super) fn taken<T>(list: &Vec<T>) -> usize {
    list.capacity() * size_of::<T>()
}

/// The same words, the same hash, on every machine.
pub(super) fn hash(words: impl IntoIterator<Item = u64>) -> u64 {
    const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;
    let mixed = words
        .into_iter()
        .fold(0_u64, |hash, word| (hash.rotate_left(23) ^ word).wrapping_mul(FACTOR));
    (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}
