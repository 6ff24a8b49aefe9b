//! Points by their packed words, and sequences of events by number.

use crate::machine::Event;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A quick hash for small keys; nothing depends on its order.
#[derive(Clone, Copy, Default)]
pub(crate) struct Quick(u64);

impl Quick {
    fn mix(&mut self, word: u64) {
        let it = (self.0 ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = it ^ (it >> 29);
    }
}

impl Hasher for Quick {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.mix(u64::from_le_bytes(word));
        }
    }

    fn write_u8(&mut self, it: u8) {
        self.mix(it as u64);
    }

    fn write_u32(&mut self, it: u32) {
        self.mix(it as u64);
    }

    fn write_u64(&mut self, it: u64) {
        self.mix(it);
    }

    fn write_usize(&mut self, it: usize) {
        self.mix(it as u64);
    }
}

/// A map with the quick hash; it is never walked through.
pub(crate) type Map<K, V> = HashMap<K, V, BuildHasherDefault<Quick>>;

/// Keys of one length, each with its number: an open table over one arena.
pub(crate) struct Keys {
    words: usize,
    arena: Vec<u64>,
    /// Numbers, below some bits of their hashes: few keys are looked at in vain.
    table: Vec<u32>,
    len: usize,
}

const FREE: u32 = u32::MAX;
/// Bits of a number; those above are of the hash.
const BITS: u32 = 25;
/// Keys that can be numbered.
pub(crate) const MAX_KEYS: usize = (1 << BITS) - 1;

fn tag(hash: u64) -> u32 {
    (hash >> 57 << BITS) as u32
}

impl Keys {
    pub(crate) fn new(words: usize) -> Keys {
        Keys { words, arena: Vec::new(), table: vec![FREE; 1 << 10], len: 0 }
    }

    pub(crate) fn get(&self, number: usize) -> &[u64] {
        &self.arena[number * self.words..(number + 1) * self.words]
    }

    pub(crate) fn bytes(&self) -> usize {
        self.arena.len() * 8 + self.table.len() * 4
    }

    fn hash(key: &[u64]) -> u64 {
        let mut hash = Quick::default();
        key.iter().for_each(|it| hash.mix(*it));
        hash.finish()
    }

    /// Compares word by word: keys are too short for a call.
    fn is(&self, number: u32, key: &[u64]) -> bool {
        self.get(number as usize).iter().zip(key).all(|it| it.0 == it.1)
    }

    /// Reads the places of keys that are looked up next, so that all are waited for at once.
    pub(crate) fn expect(&self, keys: &[u64]) {
        let mask = self.table.len() - 1;
        let places = keys.chunks_exact(self.words.max(1)).map(Keys::hash);
        let sum = places.fold(0, |sum, it| sum ^ self.table[it as usize & mask]);
        std::hint::black_box(sum);
    }

    /// Returns the number of a key, and whether it is new.
    pub(crate) fn insert(&mut self, key: &[u64]) -> (u32, bool) {
        if self.len * 2 >= self.table.len() {
            self.grow();
        }
        let mask = self.table.len() - 1;
        let hash = Keys::hash(key);
        let tag = tag(hash);
        let mut at = hash as usize & mask;
        loop {
            let it = self.table[at];
            if it == FREE {
                break;
            }
            let number = it & MAX_KEYS as u32;
            if it ^ number == tag && self.is(number, key) {
                return (number, false);
            }
            at = (at + 1) & mask;
        }
        let number = self.len as u32;
        self.table[at] = tag | number;
        self.arena.extend_from_slice(key);
        self.len += 1;
        (number, true)
    }

    fn grow(&mut self) {
        let size = self.table.len() * 2;
        let mut table = vec![FREE; size];
        for number in 0..self.len {
            let hash = Keys::hash(self.get(number));
            let mut at = hash as usize & (size - 1);
            while table[at] != FREE {
                at = (at + 1) & (size - 1);
            }
            table[at] = tag(hash) | number as u32;
        }
        self.table = table;
    }
}

/// Sequences of events, each once.
#[derive(Default)]
pub(crate) struct Sequences {
    known: Map<Vec<Event>, u32>,
    list: Vec<Vec<Event>>,
}

impl std::hash::Hash for Event {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let (sign, letter) = match self {
            Event::Asked(_, how, reply) => (*how as u32 + 1, reply.letter() as u32),
            Event::Itself(_, answer) => (4, answer.letter() as u32),
            Event::Halted(_) => (5, 0),
            Event::Moved(it) => (6, *it as u32),
            Event::Passed(it) => (0, *it),
            Event::Offered(_, part, accepted) => (7, (*part as u32) << 1 | *accepted as u32),
        };
        state.write_u32((self.node().unwrap_or(0) as u32) << 10 | sign << 7 | (letter & 0x7f));
    }
}

impl Sequences {
    /// Returns the number of a sequence.
    pub(crate) fn number(&mut self, events: &[Event]) -> u32 {
        if let Some(&it) = self.known.get(events) {
            return it;
        }
        let number = self.list.len() as u32;
        self.list.push(events.to_vec());
        self.known.insert(events.to_vec(), number);
        number
    }

    pub(crate) fn len(&self) -> u32 {
        self.list.len() as u32
    }

    pub(crate) fn get(&self, number: u32) -> &[Event] {
        &self.list[number as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_keeps_its_number_while_the_table_grows() {
        let mut keys = Keys::new(2);
        for it in 0..5_000_u64 {
            assert_eq!(keys.insert(&[it, it % 7]), (it as u32, true));
        }
        for it in 0..5_000_u64 {
            assert_eq!(keys.insert(&[it, it % 7]), (it as u32, false));
            assert_eq!(keys.get(it as usize), [it, it % 7]);
        }
    }
}
