//! A net packed for execution: a marking is a few machine words, a transition a comparison and a
//! sum.
//!
//! Every place is a field of a word, wide enough for its bound, with one guard bit above it. A
//! transition is enabled when `((marking | guards) - need) & guards == guards`: one subtraction
//! compares all fields of a word at once, and a field that holds too little borrows its own guard
//! bit and nothing else's. Firing adds a word.

mod arrays;
mod field;
mod fingerprint;
mod pack;

use super::data::{EventId, PlaceId, TransitionId};
pub use arrays::{Arrays, lines, size_of};
pub(crate) use field::width_of;
pub use field::{Field, LARGEST};
pub use pack::{is_state_machine, pack, size};

/// One transition, packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<const W: usize> {
    /// Tokens that must be there.
    pub need: [u64; W],
    /// What is added to the marking, modulo 2^64 in each word.
    pub delta: [u64; W],
    /// Its position in the net.
    pub transition: u16,
    /// Its position in [`Code::clocks`]; [`NO_CLOCK`] when it has no interval.
    pub clock: u16,
}

/// The beginning of a row without entries: beyond all of them, so that looking it up finds none.
pub const NO_ROW: u16 = u16::MAX;

/// An entry without an interval.
pub const NO_CLOCK: u16 = u16::MAX;

/// A transition with an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clock<const W: usize> {
    /// Tokens that must be there for it to run: those that its transition needs.
    pub need: [u64; W],
    /// Its position in [`Code::entries`].
    pub entry: u16,
    /// Whether it waits for an event.
    pub event: bool,
    /// Not before, in milliseconds since it became enabled.
    pub earliest: u32,
    /// Not after; `u32::MAX`: no limit.
    pub latest: u32,
}

impl<const W: usize> Clock<W> {
    /// The time beyond which it makes no difference how long it has been enabled.
    pub const fn cap(&self) -> u32 {
        if self.latest == u32::MAX { self.earliest } else { self.latest + 1 }
    }
}

/// A net packed for execution. Lists are borrowed: from flash, or from the heap.
#[derive(Clone, Copy, Debug)]
pub struct Code<'c, const W: usize> {
    /// Transitions by event, then by the state that they need, then in the order in which they are
    /// tried.
    pub entries: &'c [Entry<W>],
    /// Where the transitions of an event that a state enables begin and end in `entries`: two
    /// numbers, at `2 * (event * states + state)`; a row without any begins at [`NO_ROW`]. After
    /// those of the last event come those that fire at once by themselves, then those that fire by
    /// themselves in an interval.
    pub rows: &'c [u16],
    /// What each transition takes, by its position in the net.
    pub takes: &'c [[u64; W]],
    /// Positions in `entries` by priority, then by position in the net.
    pub order: &'c [u16],
    /// Transitions with an interval, by priority, then by position in the net.
    pub clocks: &'c [Clock<W>],
    /// Where each place lies.
    pub fields: &'c [Field],
    /// The highest bit of every field.
    pub guards: [u64; W],
    /// The bound of every field.
    pub bounds: [u64; W],
    /// The marking at the start.
    pub initial: [u64; W],
    /// For each event the places that ignore it on purpose.
    pub ignored: &'c [[u64; W]],
    /// The bits of the places of which exactly one is marked at any time; zero when the net has
    /// none such.
    pub control: u64,
    /// How many such places; one when there is none.
    pub states: u16,
    /// How many events.
    pub events: u16,
    /// The most transitions that fire at once by themselves one after another.
    pub settle: u32,
    /// Where nothing of this is marked, no transition fires at once by itself: a place of each of
    /// them, or the guard bit of one that needs no place.
    pub restless: [u64; W],
    /// Whether it is known that no bound is ever exceeded.
    pub bounded: bool,
    /// Tells nets apart.
    pub fingerprint: u64,
}

/// How long the lists of a [`Code`] are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeSize {
    /// Words of a marking.
    pub words: usize,
    /// [`Code::entries`], [`Code::takes`] and [`Code::order`].
    pub entries: usize,
    /// [`Code::rows`].
    pub rows: usize,
    /// [`Code::clocks`].
    pub clocks: usize,
    /// [`Code::fields`].
    pub fields: usize,
    /// [`Code::ignored`].
    pub events: usize,
}

/// The lists behind a [`Code`].
#[derive(Debug)]
pub struct Lists<'l, const W: usize> {
    /// As long as the net has transitions.
    pub entries: &'l mut [Entry<W>],
    /// As long as `entries`.
    pub takes: &'l mut [[u64; W]],
    /// As long as `entries`.
    pub order: &'l mut [u16],
    /// As long as [`CodeSize::rows`].
    pub rows: &'l mut [u16],
    /// As long as [`CodeSize::clocks`].
    pub clocks: &'l mut [Clock<W>],
    /// As long as the net has places.
    pub fields: &'l mut [Field],
    /// As long as the net has events.
    pub ignored: &'l mut [[u64; W]],
}

/// The lists of a [`Code`], filled by [`pack`]; see its fields.
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "they are those of `Code`")]
pub struct Borrowed<'c, const W: usize> {
    pub entries: &'c [Entry<W>],
    pub takes: &'c [[u64; W]],
    pub order: &'c [u16],
    pub rows: &'c [u16],
    pub clocks: &'c [Clock<W>],
    pub fields: &'c [Field],
    pub ignored: &'c [[u64; W]],
}

/// What is not a list in a [`Code`].
#[derive(Clone, Copy, Debug)]
pub struct Words<const W: usize> {
    /// See [`Code::guards`].
    pub guards: [u64; W],
    /// See [`Code::bounds`].
    pub bounds: [u64; W],
    /// See [`Code::initial`].
    pub initial: [u64; W],
    /// See [`Code::control`].
    pub control: u64,
    /// See [`Code::states`].
    pub states: u16,
    /// See [`Code::fingerprint`].
    pub fingerprint: u64,
}

/// See [`Code::restless`]: the first place that each transition needs which fires at once by
/// itself.
const fn restless<const W: usize>(lists: &Borrowed<'_, W>, words: &Words<W>) -> [u64; W] {
    let mut restless = [0; W];
    let (kind, states) = (2 * lists.ignored.len() * words.states as usize, words.states as usize);
    // Where the last row of a kind ends the first one of the next begins.
    let mut at = if kind == 0 { 0 } else { lists.rows[kind - 1] as usize };
    let end = lists.rows[kind + 2 * states - 1] as usize;
    while at < end {
        let need = &lists.entries[at].need;
        let mut field = 0;
        while field < lists.fields.len() && lists.fields[field].of(need) == 0 {
            field += 1;
        }
        if field < lists.fields.len() {
            let Field { word, shift, width } = lists.fields[field];
            restless[word as usize] |= ((1 << width) - 1) << shift;
        } else {
            restless[0] |= words.guards[0];
        }
        at += 1;
    }
    restless
}

impl<'c, const W: usize> Code<'c, W> {
    /// Puts lists and words together.
    pub const fn new(lists: Borrowed<'c, W>, words: &Words<W>, settle: u32, bounded: bool) -> Self {
        let Words { guards, bounds, initial, control, states, fingerprint } = *words;
        let events = lists.ignored.len() as u16;
        let restless = restless(&lists, words);
        let Borrowed { entries, takes, order, rows, clocks, fields, ignored } = lists;
        Self {
            entries,
            rows,
            takes,
            order,
            clocks,
            fields,
            guards,
            bounds,
            initial,
            ignored,
            control,
            states,
            events,
            settle,
            restless,
            bounded,
            fingerprint,
        }
    }

    /// The first transition of an event, or of a kind beyond the events, that may be enabled in
    /// this marking and `can`.
    #[inline]
    pub fn first(
        &self,
        kind: usize,
        marking: &[u64; W],
        can: impl Fn(&Entry<W>) -> bool,
    ) -> Option<&'c Entry<W>> {
        let (start, end) = self.row_bounds(kind, marking)?;
        let mut at = usize::from(start);
        loop {
            let entry = self.entries.get(at)?;
            if can(entry) {
                return Some(entry);
            }
            at += 1;
            if at >= usize::from(end) {
                return None;
            }
        }
    }

    /// The transitions of an event, or of a kind beyond the events, that may be enabled in this
    /// marking; `None` when it has none.
    #[inline]
    pub fn row(&self, kind: usize, marking: &[u64; W]) -> Option<&'c [Entry<W>]> {
        let (start, end) = self.row_bounds(kind, marking)?;
        self.entries.get(usize::from(start)..usize::from(end))
    }

    /// Where the transitions of a kind that the state enables begin in `entries`, and where they
    /// end.
    #[inline]
    fn row_bounds(&self, kind: usize, marking: &[u64; W]) -> Option<(u16, u16)> {
        let of_kind = kind.checked_mul(2 * usize::from(self.states))?;
        let row = of_kind.checked_add(self.control_bit(marking))?;
        Some((*self.rows.get(row)?, *self.rows.get(row.checked_add(1)?)?))
    }

    /// All transitions of an event, or of the kind after the events: those that fire at once by
    /// themselves, or of the kind after that: those that do in an interval.
    pub fn kind(&self, kind: usize) -> &'c [Entry<W>] {
        // Where the last row of a kind ends the first one of the next begins.
        let end = |kinds: usize| {
            let row = kinds.checked_mul(2 * usize::from(self.states))?.checked_sub(1)?;
            Some(usize::from(*self.rows.get(row)?))
        };
        let entries = end(kind.saturating_add(1))
            .and_then(|last| self.entries.get(end(kind).unwrap_or(0)..last));
        entries.unwrap_or(&[])
    }

    /// The position of the marked place of a state machine.
    #[inline]
    pub fn state(&self, marking: &[u64; W]) -> usize {
        self.control_bit(marking) / 2
    }

    /// The bit of the marked place of a state machine: twice its position. Zero for a net that is
    /// none.
    #[inline]
    fn control_bit(&self, marking: &[u64; W]) -> usize {
        let marked = marking.first().map_or(0, |word| word & self.control);
        // Most have up to sixteen states: half a word, for which small processors need half the
        // instructions.
        let bit = if self.control == 0 {
            0
        } else if u32::try_from(self.control).is_ok() {
            (marked as u32).trailing_zeros()
        } else {
            marked.trailing_zeros()
        };
        bit as usize
    }

    /// The transition that fires next at once by itself, if it `can`.
    #[inline]
    pub fn urgent(
        &self,
        marking: &[u64; W],
        can: impl Fn(&Entry<W>) -> bool,
    ) -> Option<&'c Entry<W>> {
        let mut word = 0;
        let mut resting = true;
        while word < W {
            resting &= (marking[word] | self.guards[word]) & self.restless[word] == 0;
            word += 1;
        }
        if resting { None } else { self.first(self.events as usize, marking, can) }
    }

    /// Whether these tokens are there.
    #[inline]
    pub const fn holds(&self, marking: &[u64; W], need: &[u64; W]) -> bool {
        let (mut word, mut lacking) = (0, 0);
        while word < W {
            let guards = self.guards[word];
            lacking |= !(marking[word] | guards).wrapping_sub(need[word]) & guards;
            word += 1;
        }
        lacking == 0
    }

    /// The marking after firing, whatever the bounds; a field that exceeds its bound does not
    /// disturb others.
    #[inline]
    pub const fn after(&self, marking: &[u64; W], delta: &[u64; W]) -> [u64; W] {
        let mut after = *marking;
        let mut word = 0;
        while word < W {
            after[word] = after[word].wrapping_add(delta[word]);
            word += 1;
        }
        after
    }

    /// The tokens of a place.
    #[inline]
    pub fn tokens(&self, marking: &[u64; W], place: PlaceId) -> u32 {
        self.fields.get(place.0 as usize).map_or(0, |field| field.of(marking))
    }

    /// Whether some place that ignores this event on purpose is marked.
    #[inline]
    pub fn ignores(&self, marking: &[u64; W], event: EventId) -> bool {
        self.ignored
            .get(event.0 as usize)
            .is_some_and(|mask| mask.iter().zip(marking).any(|(a, b)| a & b != 0))
    }
}

impl<const W: usize> Entry<W> {
    /// Its position in the net.
    #[inline]
    pub const fn id(&self) -> TransitionId {
        TransitionId(self.transition as u32)
    }
}
