//! Markings that a thread sorts by their tables before it adds them.

use super::table::{TABLES, hash, table_of};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The boxes of a thread, one for each table; apart from those of another thread in the caches of processors.
#[derive(Debug)]
#[repr(align(128))]
pub(super) struct Boxes<const S: usize> {
    markings: Vec<[u64; S]>,
    /// For each marking the transition that leads to it.
    via: Vec<u32>,
    /// For each box where its next marking goes.
    ends: [usize; TABLES],
    /// The box that is emptied first.
    first: usize,
    /// How many were given to be emptied.
    given: AtomicUsize,
}

impl<const S: usize> Boxes<S> {
    /// How many markings a box holds, a power of two: enough that many of them lie near each other in the table.
    const ROOM: usize = 1 << (4096 / S).ilog2();

    /// Empty ones.
    pub(super) fn new(first: usize) -> Self {
        Self {
            markings: vec![[0; S]; TABLES * Self::ROOM],
            via: vec![0; TABLES * Self::ROOM],
            ends: Self::starts(),
            first,
            given: AtomicUsize::new(0),
        }
    }

    fn starts() -> [usize; TABLES] {
        std::array::from_fn(|table| table * Self::ROOM)
    }

    /// Puts a marking into its box; returns the box if it is full now, to be emptied before the next marking.
    #[inline]
    pub(super) fn put(&mut self, marking: &[u64; S], via: u32) -> Option<usize> {
        let table = table_of(hash(marking));
        let end = self.ends[table];
        self.markings[end] = *marking;
        self.via[end] = via;
        self.ends[table] = end + 1;
        (end + 1).is_multiple_of(Self::ROOM).then_some(table)
    }

    /// What is in a box: markings, and for each the transition that leads to it.
    pub(super) fn content(&self, table: usize) -> (&[[u64; S]], &[u32]) {
        let range = table * Self::ROOM..self.ends[table];
        (&self.markings[range.clone()], &self.via[range])
    }

    /// Empties a box.
    pub(super) fn clear(&mut self, table: usize) {
        self.ends[table] = table * Self::ROOM;
    }

    /// Empties all.
    pub(super) fn clear_all(&mut self) {
        self.ends = Self::starts();
        *self.given.get_mut() = 0;
    }

    /// The next box with something in it; no two threads are given the same one.
    pub(super) fn next(&self) -> Option<usize> {
        loop {
            let at = self.given.fetch_add(1, Relaxed);
            let table = (at < TABLES).then_some((self.first + at) % TABLES)?;
            if self.ends[table] > table * Self::ROOM {
                return Some(table);
            }
        }
    }
}
