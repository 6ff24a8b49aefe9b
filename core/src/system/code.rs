//! A system packed for execution: one marking for all its nets and mailboxes.
//!
//! Places, shared ones counted once, then the complements that only the system needs, then a pair
//! of fields for each mailbox (what waits, and the room that is left) are fields of one packed
//! marking, as in [`net::code`](crate::net::code).

pub use super::arrays::{Arrays, size_of};
pub use super::pack::{pack, size};
use crate::net::code::Field;

/// No clock, no mailbox.
pub const NONE: u16 = u16::MAX;

/// A transition of one of the nets, packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<const W: usize> {
    /// Tokens that must be there.
    pub need: [u64; W],
    /// What is added to the marking, modulo 2^64 in each word.
    pub delta: [u64; W],
    /// Its component.
    pub component: u16,
    /// Its position in the net of the component.
    pub transition: u16,
    /// Its position among the clocks, or [`NONE`].
    pub clock: u16,
    /// Where its outputs begin in [`Code::routes`], and where they end.
    pub routes: (u16, u16),
}

/// A transition with an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clock {
    /// Its position in [`Code::entries`].
    pub entry: u16,
    /// Whether it waits for an event.
    pub event: bool,
    /// Not before, in milliseconds since it became enabled.
    pub earliest: u32,
    /// Not after; `u32::MAX`: no limit.
    pub latest: u32,
}

/// Where an output goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Route {
    /// The event, counted over all nets.
    pub event: u16,
    /// The mailbox, or [`NONE`] when the event happens at once.
    pub mailbox: u16,
}

/// Where what is under way waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mailbox {
    /// The event, counted over all nets.
    pub event: u16,
    /// How many wait.
    pub waiting: Field,
    /// For how many more there is room.
    pub room: Field,
    /// Where what they carry begins.
    pub slot: u16,
    /// How many can wait.
    pub capacity: u16,
}

/// A system packed for execution.
#[derive(Clone, Copy, Debug)]
pub struct Code<'c, const W: usize> {
    /// Transitions by row.
    pub entries: &'c [Entry<W>],
    /// Tokens that each of them removes: clocks ask what is there in between. Nothing is listed
    /// without clocks.
    pub takes: &'c [[u64; W]],
    /// Where rows begin in `entries`: events counted over all nets, then for each net what fires at
    /// once by itself, then all that fires by itself in an interval.
    pub rows: &'c [u16],
    /// Where the outputs of all entries go.
    pub routes: &'c [Route],
    /// Mailboxes, by component and then by event.
    pub mailboxes: &'c [Mailbox],
    /// For each component where its mailboxes begin, and at the end how many there are.
    pub turns: &'c [u16],
    /// For each component the number of its first event, and at the end how many there are.
    pub events: &'c [u16],
    /// For each component the position of its first place in `fields`, and at the end how many
    /// there are.
    pub places: &'c [u16],
    /// Where each place of each net lies.
    pub fields: &'c [Field],
    /// Transitions with an interval.
    pub clocks: &'c [Clock],
    /// Pairs of an event, counted over all nets, and a mailbox that it empties.
    pub clears: &'c [(u16, u16)],
    /// The highest bit of every field.
    pub guards: [u64; W],
    /// The bound of every field.
    pub bounds: [u64; W],
    /// The marking at the start.
    pub initial: [u64; W],
}

/// How long the lists of a [`Code`] are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "they are the lists of `Code`")]
pub struct Size {
    pub words: usize,
    pub components: usize,
    pub entries: usize,
    pub takes: usize,
    pub rows: usize,
    pub routes: usize,
    pub mailboxes: usize,
    pub fields: usize,
    pub clocks: usize,
    pub clears: usize,
    /// What can wait in all mailboxes together.
    pub slots: usize,
}

/// The lists of a [`Code`] to be filled, as long as [`size`] says.
#[derive(Debug)]
#[expect(missing_docs, reason = "they are those of `Code`")]
pub struct Lists<'l, const W: usize> {
    pub entries: &'l mut [Entry<W>],
    pub takes: &'l mut [[u64; W]],
    pub rows: &'l mut [u16],
    pub routes: &'l mut [Route],
    pub mailboxes: &'l mut [Mailbox],
    pub turns: &'l mut [u16],
    pub events: &'l mut [u16],
    pub places: &'l mut [u16],
    pub fields: &'l mut [Field],
    pub clocks: &'l mut [Clock],
    pub clears: &'l mut [(u16, u16)],
}

/// What is not a list in a [`Code`].
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "they are those of `Code`")]
pub struct Words<const W: usize> {
    pub guards: [u64; W],
    pub bounds: [u64; W],
    pub initial: [u64; W],
}
