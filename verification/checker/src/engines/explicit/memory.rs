//! The memory that a search takes of what it may.

use super::Limit;

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
        debug_assert!(bytes <= self.used, "no more is given back than was taken");
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

    pub(super) fn give_back<T>(&mut self, list: &Vec<T>) {
        self.used -= self.used.min((list.capacity() * size_of::<T>()) as u64);
    }
}
