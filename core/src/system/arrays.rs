//! The lists of a packed system: of lengths known when compiling, or on the heap.

use super::code::{Clock, Code, Entry, Lists, Mailbox, NONE, Route, Size, Words, pack, size};
use super::data::System;
use crate::net::code::Field;

const FIELD: Field = Field { word: 0, shift: 0, width: 1 };
const ROUTE: Route = Route { event: 0, mailbox: NONE };
const MAILBOX: Mailbox = Mailbox { event: 0, waiting: FIELD, room: FIELD, slot: 0, capacity: 0 };
const CLOCK: Clock = Clock { entry: 0, event: false, earliest: 0, latest: 0 };

const fn entry<const W: usize>() -> Entry<W> {
    Entry { need: [0; W], delta: [0; W], component: 0, transition: 0, clock: NONE, routes: (0, 0) }
}

/// [`size`], in a `const`.
///
/// # Panics
/// When the system is too large: at compile time.
pub const fn size_of(system: &System<'_>) -> Size {
    match size(system) {
        Some(size) => size,
        None => panic!("a system has at most 65,534 transitions, places, events and routes"),
    }
}

/// The lists of a [`Code`] whose lengths are known when compiling.
#[derive(Clone, Copy, Debug)]
pub struct Arrays<
    const W: usize,
    const T: usize,
    const K: usize,
    const R: usize,
    const O: usize,
    const B: usize,
    const N: usize,
    const P: usize,
    const C: usize,
    const E: usize,
> {
    entries: [Entry<W>; T],
    takes: [[u64; W]; K],
    rows: [u16; R],
    routes: [Route; O],
    mailboxes: [Mailbox; B],
    turns: [u16; N],
    events: [u16; N],
    places: [u16; N],
    fields: [Field; P],
    clocks: [Clock; C],
    clears: [(u16, u16); E],
    words: Words<W>,
}

impl<
    const W: usize,
    const T: usize,
    const K: usize,
    const R: usize,
    const O: usize,
    const B: usize,
    const N: usize,
    const P: usize,
    const C: usize,
    const E: usize,
> Arrays<W, T, K, R, O, B, N, P, C, E>
{
    /// Packs a system; the lengths are those of [`size_of`].
    pub const fn of(system: &System<'_>) -> Self {
        let mut it = Self {
            entries: [entry(); T],
            takes: [[0; W]; K],
            rows: [0; R],
            routes: [ROUTE; O],
            mailboxes: [MAILBOX; B],
            turns: [0; N],
            events: [0; N],
            places: [0; N],
            fields: [FIELD; P],
            clocks: [CLOCK; C],
            clears: [(0, 0); E],
            words: Words { guards: [0; W], bounds: [0; W], initial: [0; W] },
        };
        it.words = pack(
            system,
            &mut Lists {
                entries: &mut it.entries,
                takes: &mut it.takes,
                rows: &mut it.rows,
                routes: &mut it.routes,
                mailboxes: &mut it.mailboxes,
                turns: &mut it.turns,
                events: &mut it.events,
                places: &mut it.places,
                fields: &mut it.fields,
                clocks: &mut it.clocks,
                clears: &mut it.clears,
            },
        );
        it
    }

    /// The packed system.
    pub const fn code(&self) -> Code<'_, W> {
        let Words { guards, bounds, initial } = self.words;
        Code {
            entries: &self.entries,
            takes: &self.takes,
            rows: &self.rows,
            routes: &self.routes,
            mailboxes: &self.mailboxes,
            turns: &self.turns,
            events: &self.events,
            places: &self.places,
            fields: &self.fields,
            clocks: &self.clocks,
            clears: &self.clears,
            guards,
            bounds,
            initial,
        }
    }
}

/// A system made at run time, packed on the heap.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
pub struct Packed<const W: usize> {
    entries: alloc::vec::Vec<Entry<W>>,
    takes: alloc::vec::Vec<[u64; W]>,
    rows: alloc::vec::Vec<u16>,
    routes: alloc::vec::Vec<Route>,
    mailboxes: alloc::vec::Vec<Mailbox>,
    turns: alloc::vec::Vec<u16>,
    events: alloc::vec::Vec<u16>,
    places: alloc::vec::Vec<u16>,
    fields: alloc::vec::Vec<Field>,
    clocks: alloc::vec::Vec<Clock>,
    clears: alloc::vec::Vec<(u16, u16)>,
    words: Words<W>,
}

#[cfg(feature = "alloc")]
impl<const W: usize> Packed<W> {
    /// Packs a system.
    ///
    /// # Errors
    /// The defect of the system; [`TooLong`](super::SystemDefect::TooLong) when it needs more than
    /// `W` words or is too large. Its nets are taken to be [sound](crate::net::Net::defect).
    pub fn of(system: &System<'_>) -> Result<Self, super::SystemDefect> {
        use alloc::vec;
        if let Some(defect) = system.defect() {
            return Err(defect);
        }
        let size =
            size(system).filter(|size| size.words <= W).ok_or(super::SystemDefect::TooLong)?;
        let mut it = Self {
            entries: vec![entry(); size.entries],
            takes: vec![[0; W]; size.takes],
            rows: vec![0; size.rows],
            routes: vec![ROUTE; size.routes],
            mailboxes: vec![MAILBOX; size.mailboxes],
            turns: vec![0; size.components + 1],
            events: vec![0; size.components + 1],
            places: vec![0; size.components + 1],
            fields: vec![FIELD; size.fields],
            clocks: vec![CLOCK; size.clocks],
            clears: vec![(0, 0); size.clears],
            words: Words { guards: [0; W], bounds: [0; W], initial: [0; W] },
        };
        it.words = pack(
            system,
            &mut Lists {
                entries: &mut it.entries,
                takes: &mut it.takes,
                rows: &mut it.rows,
                routes: &mut it.routes,
                mailboxes: &mut it.mailboxes,
                turns: &mut it.turns,
                events: &mut it.events,
                places: &mut it.places,
                fields: &mut it.fields,
                clocks: &mut it.clocks,
                clears: &mut it.clears,
            },
        );
        Ok(it)
    }

    /// The packed system, to be run.
    pub fn code(&self) -> Code<'_, W> {
        let Words { guards, bounds, initial } = self.words;
        Code {
            entries: &self.entries,
            takes: &self.takes,
            rows: &self.rows,
            routes: &self.routes,
            mailboxes: &self.mailboxes,
            turns: &self.turns,
            events: &self.events,
            places: &self.places,
            fields: &self.fields,
            clocks: &self.clocks,
            clears: &self.clears,
            guards,
            bounds,
            initial,
        }
    }
}
