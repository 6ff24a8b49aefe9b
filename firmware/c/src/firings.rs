//! Firings, noted in the caller's memory.

use crate::error::cotama_error;
use crate::memory::{Out, Pieces};
use crate::tables::Says;
use core::ffi::c_char;
use cotama_core::player::{Firing, Names, Observer};
use cotama_core::system::Of;

/// "None", where a number stands for something: no configuration, no axis.
pub const COTAMA_NONE: u32 = u32::MAX;

/// "Never", where a number is an instant.
pub const COTAMA_NEVER: u64 = u64::MAX;

/// A text of so many bytes, with no zero at the end: `printf("%.*s", (int)it.length, it.bytes)`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cotama_text {
    /// Start of the text; it stays there as long as the program runs.
    pub bytes: *const c_char,
    /// How many bytes it has.
    pub length: usize,
}

impl From<&'static str> for cotama_text {
    fn from(text: &'static str) -> Self {
        Self { bytes: text.as_ptr().cast(), length: text.len() }
    }
}

/// A transition that has fired.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_firing {
    /// When, ms: what was due earlier than the call fired when it was due.
    pub at_ms: u64,
    /// The outputs emitted: bit `n` is output `n` of its net.
    pub outputs: u64,
    /// Number of the net in the system; 0 for a net alone.
    pub net: u32,
    /// The transition, by its number in the net.
    pub transition: u32,
}

/// Memory for what fires during a call, in its order.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cotama_firings {
    /// Memory for firings; null when `room` is 0.
    pub list: *mut cotama_firing,
    /// For how many.
    pub room: usize,
    /// How many there were: written by each call. Those beyond `room` are counted, not noted.
    pub count: usize,
}

/// Notes firings.
pub(crate) struct Notes<'l> {
    /// The outputs of transitions.
    says: Says<'static>,
    to: Option<Out<cotama_firings>>,
    list: &'l mut [cotama_firing],
    count: usize,
}

impl Notes<'_> {
    /// # Safety
    /// `firings` is null, or points to such a value whose list has as much room as it says.
    pub(crate) unsafe fn new(
        says: Says<'static>,
        firings: *mut cotama_firings,
        pieces: &mut Pieces,
    ) -> Result<Self, cotama_error> {
        if firings.is_null() {
            return Ok(Self { says, to: None, list: &mut [], count: 0 });
        }
        // SAFETY: it is promised that such a value is there, and that the list has this room.
        let (to, list) = unsafe {
            let (given, to) = pieces.change(firings)?;
            (to, pieces.list_to_write(given.list, given.room)?)
        };
        Ok(Self { says, to: Some(to), list, count: 0 })
    }

    /// Tells the caller how many there were.
    pub(crate) fn end(self) {
        if let Some(to) = self.to {
            // SAFETY: the address was checked when the notes began.
            unsafe { (&raw mut (*to.address()).count).write(self.count) };
        }
    }
}

impl<P: Names, M> Observer<P, M> for Notes<'_> {
    fn on_fire(&mut self, firing: &Firing<'_, P, M>) {
        let Of { component, id } = firing.id;
        let outputs = self.says.of(component, id.0);
        if let Some(place) = self.list.get_mut(self.count) {
            let net = u32::from(component);
            *place = cotama_firing { at_ms: firing.at.0, outputs, net, transition: id.0 };
        }
        self.count = self.count.saturating_add(1);
    }
}
