//! What a family of drawn instances takes, and what is answered: lines of a golden file. Whoever
//! makes a search quicker or slower, or has it find another answer of the same worth, sees where.

use std::fmt::{Debug, Write};

#[path = "digest.rs"]
mod digest;

use digest::Digest;

/// Lines, each of so many instances: their counts added up, and a digest of all that was noted.
pub struct Effort {
    text: String,
    each: usize,
    instances: usize,
    counts: Vec<(&'static str, u64)>,
    digest: Digest,
}

impl Effort {
    pub fn new(each: usize) -> Self {
        let (text, counts) = (String::new(), Vec::new());
        Self { text, each, instances: 0, counts, digest: Digest::EMPTY }
    }

    /// Adds to what is counted under this name.
    pub fn count(&mut self, name: &'static str, number: u64) {
        match self.counts.iter_mut().find(|it| it.0 == name) {
            Some((_, sum)) => *sum += number,
            None => self.counts.push((name, number)),
        }
    }

    /// Adds to the digest what stands in a debug print.
    pub fn note(&mut self, what: &impl Debug) {
        write!(self.digest, "{what:?};").expect("a digest takes all");
    }

    /// How many instances have ended.
    #[allow(dead_code)] // not all families ask
    pub const fn instances(&self) -> usize {
        self.instances
    }

    /// An instance ends.
    pub fn next(&mut self) {
        self.instances += 1;
        if self.instances.is_multiple_of(self.each) {
            let first = self.instances - self.each;
            self.counts.sort_unstable();
            for (name, count) in self.counts.drain(..) {
                write!(self.text, "{name} {count}, ").expect("a string takes all");
            }
            let digest = std::mem::replace(&mut self.digest, Digest::EMPTY);
            writeln!(self.text, "{:016x} of {first}..{}", digest.0, self.instances)
                .expect("a string takes all");
        }
    }

    /// Compares with a golden file.
    ///
    /// # Panics
    /// When it differs, or when instances are left that fill no line.
    #[track_caller]
    pub fn compare(&self, path: &str) {
        assert!(self.instances.is_multiple_of(self.each) && !self.text.is_empty());
        cotama_golden::compare(path, &self.text);
    }
}
