//! Failures that were found, noted in the caller's memory.

use crate::error::cotama_error;
use crate::memory::{Out, Pieces};

/// Memory for the failures that are found during a call, the worst first, each a
/// `COTAMA_FAILURE_...`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cotama_failures {
    /// Memory for failures; null when `room` is 0.
    pub list: *mut u32,
    /// For how many.
    pub room: usize,
    /// Number of them: written by each call. Those beyond `room` are counted, not noted.
    pub count: usize,
}

/// The caller's memory for failures, checked before anything happens.
pub(crate) struct Found<'l> {
    to: Out<cotama_failures>,
    list: &'l mut [u32],
}

impl Found<'_> {
    /// # Safety
    /// `failures` is null, which means that nobody wants them, or points to such a value whose list
    /// has as much room as it says.
    pub(crate) unsafe fn wanted(
        failures: *mut cotama_failures,
        pieces: &mut Pieces,
    ) -> Result<Option<Self>, cotama_error> {
        if failures.is_null() {
            return Ok(None);
        }
        // SAFETY: it is promised that such a value is there, and that the list has this room.
        unsafe {
            let (given, to) = pieces.change(failures)?;
            Ok(Some(Self { to, list: pieces.list_to_write(given.list, given.room)? }))
        }
    }

    /// Notes them, and how many there are.
    pub(crate) fn put(self, count: u32, failures: impl Iterator<Item = usize>) {
        self.list.iter_mut().zip(failures).for_each(|(place, it)| *place = it as u32);
        // SAFETY: the address was checked when the memory was named.
        unsafe { (&raw mut (*self.to.address()).count).write(count as usize) };
    }
}
