//! Markings that a thread sorts by their tables before it adds them.

use super::table::{TABLES, hash, table_of};
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The boxes of a thread, one for each table; apart from those of another thread in the caches of
/// processors.
#[derive(Debug)]
#[repr(align(128))]
pub(super) struct Boxes<const S: usize> {
    markings: Vec<[u64; S]>,
    /// For each marking the transition that leads to it.
    via: Vec<u32>,
    /// For each box where its next marking goes.
    ends: [usize; TABLES],
    /// For each thread's share of the tables the box that is given next to be emptied.
    given: Vec<AtomicUsize>,
}

impl<const S: usize> Boxes<S> {
    /// How many markings a box holds, a power of two: enough that many of them lie near each other
    /// in the table.
    const ROOM: usize = 1 << (4096 / S).ilog2();

    /// Empty ones.
    pub(super) fn new(threads: usize) -> Self {
        Self {
            markings: vec![[0; S]; TABLES * Self::ROOM],
            via: vec![0; TABLES * Self::ROOM],
            ends: Self::starts(),
            given: (0..threads).map(|it| AtomicUsize::new(share(it, threads).start)).collect(),
        }
    }

    fn starts() -> [usize; TABLES] {
        std::array::from_fn(|table| table * Self::ROOM)
    }

    /// Puts a marking into its box; returns the box if it is full now, to be emptied before the
    /// next marking.
    #[inline]
    pub(super) fn put(&mut self, marking: &[u64; S], via: u32) -> Option<usize> {
        let table = table_of(hash(marking));
        let end = self.ends[table];
        self.markings[end] = *marking;
        self.via[end] = via;
        self.ends[table] = end + 1;
        (end + 1).is_multiple_of(Self::ROOM).then_some(table)
    }

    /// Returns the contents of a box: markings, and for each the transition that leads to it.
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
        let threads = self.given.len();
        for (thread, given) in self.given.iter_mut().enumerate() {
            *given.get_mut() = share(thread, threads).start;
        }
    }

    /// The next box with something in it, of this thread's share of the tables; no two threads are
    /// given the same one.
    pub(super) fn next(&self, owner: usize) -> Option<usize> {
        let end = share(owner, self.given.len()).end;
        loop {
            let table = self.given[owner].fetch_add(1, Relaxed);
            if table >= end {
                return None;
            }
            if self.ends[table] > table * Self::ROOM {
                return Some(table);
            }
        }
    }
}

/// The tables that a thread adds to before it helps others with theirs.
fn share(thread: usize, threads: usize) -> Range<usize> {
    thread * TABLES / threads..(thread + 1) * TABLES / threads
}
