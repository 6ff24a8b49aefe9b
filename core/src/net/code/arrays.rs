//! A net packed while compiling: lists whose lengths are types.

use super::field::Field;
use super::pack::{pack, size};
use super::{Borrowed, Clock, Code, CodeSize, Entry, Lists, NO_CLOCK, Words};
use crate::net::data::Net;

/// [`size`], in a `const`.
///
/// # Panics
/// When the net has too many transitions, events or places: at compile time.
pub const fn size_of(net: &Net<'_>) -> CodeSize {
    match size(net) {
        Some(size) => size,
        None => panic!("a net has at most 65,533 places, events and transitions"),
    }
}

/// The line of each transition.
pub const fn lines<const T: usize>(net: &Net<'_>) -> [u16; T] {
    let mut lines = [0; T];
    let mut at = 0;
    while at < T && at < net.transitions.len() {
        lines[at] = net.transitions[at].line as u16;
        at += 1;
    }
    lines
}

/// The lists of a [`Code`] whose lengths are known when compiling, those first that every event
/// needs.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Arrays<
    const W: usize,
    const T: usize,
    const R: usize,
    const C: usize,
    const P: usize,
    const E: usize,
> {
    entries: [Entry<W>; T],
    rows: [u16; R],
    takes: [[u64; W]; T],
    order: [u16; T],
    clocks: [Clock<W>; C],
    fields: [Field; P],
    ignored: [[u64; W]; E],
    words: Words<W>,
}

impl<const W: usize, const T: usize, const R: usize, const C: usize, const P: usize, const E: usize>
    Arrays<W, T, R, C, P, E>
{
    /// Packs a net; the lengths are those of [`size_of`].
    pub const fn of(net: &Net<'_>) -> Self {
        let entry = Entry { need: [0; W], delta: [0; W], transition: 0, clock: NO_CLOCK };
        let mut it = Self {
            entries: [entry; T],
            takes: [[0; W]; T],
            order: [0; T],
            rows: [0; R],
            clocks: [Clock { need: [0; W], entry: 0, event: false, earliest: 0, latest: 0 }; C],
            fields: [Field { word: 0, shift: 0, width: 1 }; P],
            ignored: [[0; W]; E],
            words: Words {
                guards: [0; W],
                bounds: [0; W],
                initial: [0; W],
                control: 0,
                states: 1,
                fingerprint: 0,
            },
        };
        let mut lists = Lists {
            entries: &mut it.entries,
            takes: &mut it.takes,
            order: &mut it.order,
            rows: &mut it.rows,
            clocks: &mut it.clocks,
            fields: &mut it.fields,
            ignored: &mut it.ignored,
        };
        it.words = pack(net, &mut lists);
        it
    }

    /// The packed net.
    pub const fn code(&self, settle: u32, bounded: bool) -> Code<'_, W> {
        let Self { entries, takes, order, rows, clocks, fields, ignored, words } = self;
        Code::new(
            Borrowed { entries, takes, order, rows, clocks, fields, ignored },
            words,
            settle,
            bounded,
        )
    }
}
