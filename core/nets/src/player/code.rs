//! A system packed for execution: a marking is a few machine words, a transition a comparison and a
//! sum.
//!
//! Every place is a field of a word, wide enough for its bound, with one guard bit above it. A
//! transition is enabled when `((marking | guards) - need) & guards == guards`: one subtraction
//! compares all fields of a word at once, and a field that holds too little borrows its own guard
//! bit and nothing else's. Firing adds a word.
//!
//! Places come first, a shared one counted once. A mailbox is two fields more: what waits, and the
//! room that is left. A net alone is a system of one component, without links.
//!
//! Transitions, events and places are numbered over all nets, in the order of the components.

use super::field::Field;
use super::lists::{borrowed, each_list};
use crate::net::data::{EventId, PlaceId, TransitionId};
use crate::system::data::Of;

/// One transition as it is listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Position in [`Code::needs`].
    pub need: u16,
    /// Position in [`Code::deltas`].
    pub delta: u16,
    /// Number of the transition.
    pub transition: u16,
    /// Position of its clock in [`Code::clocks`]; [`NONE`] when it has no interval.
    pub clock: u16,
}

/// One transition with its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<'c, const W: usize> {
    /// Tokens that must be there.
    pub need: &'c [u64; W],
    /// The words added to the marking, modulo 2^64 in each word.
    pub delta: &'c [u64; W],
    /// See [`Listed::transition`].
    pub transition: u16,
    /// See [`Listed::clock`].
    pub clock: u16,
}

/// No clock, no mailbox, no row.
pub const NONE: u16 = u16::MAX;

/// A transition with an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clock<const W: usize> {
    /// Tokens that must be there for it to run: those that its transition needs.
    pub need: [u64; W],
    /// Position of the transition in [`Code::entries`].
    pub entry: u16,
    /// Whether it waits for an event.
    pub event: bool,
    /// Least age at firing, in milliseconds since the transition became enabled.
    pub earliest: u32,
    /// Largest age at firing, in milliseconds; `u32::MAX` means no limit.
    pub latest: u32,
}

impl<const W: usize> Clock<W> {
    /// The age at which its clock stops: a longer one makes no difference.
    pub const fn cap(&self) -> u32 {
        if self.latest == u32::MAX { self.earliest } else { self.latest + 1 }
    }

    /// Whether its interval is open when it has been enabled for so long. For a transition without
    /// event the end does not count: it fires as soon as it can.
    #[inline]
    pub const fn is_open(&self, elapsed: u32) -> bool {
        self.earliest <= elapsed
            && (!self.event || self.latest == u32::MAX || elapsed <= self.latest)
    }
}

/// The destination of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Route {
    /// The number of the event.
    pub event: u16,
    /// The position of its mailbox, or [`NONE`] when the event happens at once.
    pub mailbox: u16,
}

/// The place where events of one kind wait for the turn of their net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mailbox {
    /// The number of the event.
    pub event: u16,
    /// The field that counts how many wait.
    pub waiting: Field,
    /// The field that counts how many more have room, if a transition asks for that.
    pub room: Option<Field>,
    /// The first of its slots, which hold what the events carry.
    pub slot: u16,
    /// How many can wait.
    pub capacity: u16,
}

each_list!(borrowed);

/// A weighted sum of tokens that stays the same, or two places that are never both marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kept {
    /// The component.
    pub component: u16,
    /// The position in [`Net::laws`](crate::net::data::Net::laws); [`NONE`] for a place and its
    /// complement.
    pub law: u16,
    /// Start of its places in [`Code::summands`].
    pub first: u16,
    /// End of its places.
    pub end: u16,
    /// The sum; `None` where one of them at most is marked.
    pub equals: Option<u32>,
}

impl Kept {
    pub(super) const NOTHING: Self =
        Self { component: 0, law: NONE, first: 0, end: 0, equals: None };
}

/// The parts of a [`Code`] that are no lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words<const W: usize> {
    /// The highest bit of every field.
    pub guards: [u64; W],
    /// The bound of every field.
    pub bounds: [u64; W],
    /// The marking at the start.
    pub initial: [u64; W],
    /// Bits of which one is set wherever a transition fires at once by itself: a place of each such
    /// transition, or the guard bit if it needs no place.
    pub restless: [u64; W],
    /// The bits of the places of which exactly one is marked at any time; zero unless it is a net
    /// alone that is such a state machine.
    pub control: u64,
    /// How many such places; one when there is none.
    pub states: u16,
    /// Tells systems apart.
    pub fingerprint: u64,
    /// How many distinct needs there are.
    pub needs: u16,
    /// How many distinct deltas there are.
    pub deltas: u16,
}

impl<const W: usize> Words<W> {
    pub(super) const NOTHING: Self = Self {
        guards: [0; W],
        bounds: [0; W],
        initial: [0; W],
        restless: [0; W],
        control: 0,
        states: 1,
        fingerprint: 0,
        needs: 0,
        deltas: 0,
    };
}

/// How long the lists of a [`Code`] are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "they are the lists of `Code`")]
pub struct Size {
    /// Words of a marking.
    pub words: usize,
    pub components: usize,
    pub entries: usize,
    pub needs: usize,
    pub deltas: usize,
    pub takes: usize,
    pub rows: usize,
    pub routes: usize,
    pub says: usize,
    pub mailboxes: usize,
    pub fields: usize,
    pub complements: usize,
    pub clocks: usize,
    pub clears: usize,
    pub ignored: usize,
    pub ignored_where: usize,
    pub kept: usize,
    pub summands: usize,
    /// The most events that can wait in all mailboxes together.
    pub slots: usize,
}

impl<'c, const W: usize> Code<'c, W> {
    /// Whether it is a net alone: what an event does ends when the net has settled.
    #[inline]
    pub const fn is_alone(&self) -> bool {
        self.turns.len() <= 2 && self.routes.is_empty()
    }

    /// Returns the number of components.
    #[inline]
    pub(super) const fn components(&self) -> usize {
        self.turns.len().saturating_sub(1)
    }

    /// How many events over all nets: the first kind beyond them is what fires at once by itself.
    #[inline]
    pub(super) fn first_urgent(&self) -> usize {
        debug_assert!(self.events.len() == self.turns.len(), "the lists are of one system");
        self.events.last().map_or(0, |&it| usize::from(it))
    }

    /// The kind of what fires by itself in an interval.
    #[inline]
    pub(super) fn timed(&self) -> usize {
        self.first_urgent().saturating_add(self.components())
    }

    /// The transition at a position in `entries`.
    #[inline]
    pub const fn entry(&self, at: usize) -> Option<Entry<'c, W>> {
        if at >= self.entries.len() {
            return None;
        }
        let Listed { need, delta, transition, clock } = self.entries[at];
        // Each has its own words in lists of single ones: no position is looked up there.
        let own = W == 1;
        debug_assert!(!own || need as usize == at && delta as usize == at, "as it is packed");
        let (need, delta) = if own { (at, at) } else { (need as usize, delta as usize) };
        let (need, delta) = (words(self.needs, need), words(self.deltas, delta));
        Some(Entry { need, delta, transition, clock })
    }

    /// The position of the first transition of a kind that may be enabled in this marking and
    /// `can`.
    #[inline]
    pub fn first(
        &self,
        kind: usize,
        marking: &[u64; W],
        can: impl Fn(&Entry<'c, W>) -> bool,
    ) -> Option<u16> {
        let (start, end) = self.row(kind, marking)?;
        let mut at = usize::from(start);
        loop {
            debug_assert!(start == NONE || end as usize <= self.entries.len(), "a row of entries");
            if can(&self.entry(at)?) {
                return Some(at as u16);
            }
            at = at.wrapping_add(1); // an end is no larger than a `u16`
            if at >= usize::from(end) {
                return None;
            }
        }
    }

    /// The first and the end in `entries` of the transitions of a kind that may be enabled in this
    /// marking; `None` when there is no such kind.
    #[inline]
    pub fn row(&self, kind: usize, marking: &[u64; W]) -> Option<(u16, u16)> {
        let of_kind = kind.checked_mul(2 * usize::from(self.states))?;
        let row = of_kind.checked_add(self.control_bit(marking))?;
        Some((*self.rows.get(row)?, *self.rows.get(row.checked_add(1)?)?))
    }

    /// The first and the end in `entries` of the transitions of some kinds that follow each other.
    pub(super) fn span(&self, kinds: core::ops::Range<usize>) -> (u16, u16) {
        // The last row of a kind ends at the first one of the next.
        let end = |kinds: usize| {
            let row = kinds.checked_mul(2 * usize::from(self.states))?.checked_sub(1)?;
            self.rows.get(row).copied()
        };
        let (first, end) = (end(kinds.start).unwrap_or(0), end(kinds.end).unwrap_or(0));
        debug_assert!(first <= end && usize::from(end) <= self.entries.len(), "a span of entries");
        (first, end)
    }

    /// All transitions of some kinds that follow each other.
    pub(super) fn kinds(&self, kinds: core::ops::Range<usize>) -> &'c [Listed] {
        let (first, end) = self.span(kinds);
        self.entries.get(usize::from(first)..usize::from(end)).unwrap_or(&[])
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
        debug_assert!(self.control == 0 || marked.is_power_of_two(), "one state is marked");
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

    /// Whether it is clear at once that nothing fires at once by itself.
    #[inline]
    pub(super) const fn rests(&self, marking: &[u64; W]) -> bool {
        let mut word = 0;
        let mut rests = true;
        while word < W {
            rests &= (marking[word] | self.guards[word]) & self.restless[word] == 0;
            word += 1;
        }
        rests
    }

    /// Whether these tokens are there.
    #[inline]
    pub const fn holds(&self, marking: &[u64; W], need: &[u64; W]) -> bool {
        let (mut word, mut lacking) = (0, 0);
        // Most transitions that lack anything lack it in the first words.
        while word < W && lacking == 0 {
            let guards = self.guards[word];
            lacking |= !(marking[word] | guards).wrapping_sub(need[word]) & guards;
            word += 1;
        }
        lacking == 0
    }

    /// The tokens of a place.
    #[inline]
    pub fn tokens(&self, marking: &[u64; W], place: impl Into<Of<PlaceId>>) -> u32 {
        let place = place.into();
        let at = number(self.places, place.component, place.id.0);
        at.and_then(|at| self.fields.get(at)).map_or(0, |field| field.of(marking))
    }

    /// The number of an event.
    #[inline]
    pub fn event_number(&self, event: Of<EventId>) -> Option<usize> {
        number(self.events, event.component, event.id.0)
    }

    /// The event of a number.
    pub fn event(&self, number: u16) -> Of<EventId> {
        let (component, id) = of(self.events, number);
        Of { component, id: EventId(id) }
    }

    /// The transition of a number.
    #[inline]
    pub fn transition(&self, number: u16) -> Of<TransitionId> {
        let (component, id) = of(self.transitions, number);
        Of { component, id: TransitionId(id) }
    }

    /// Whether some place that ignores this event on purpose is marked, and the guard holds.
    #[inline]
    pub fn ignores(&self, marking: &[u64; W], event: usize) -> bool {
        self.ignored.iter().any(|&(ignored, place)| {
            usize::from(ignored) == event
                && self.fields.get(usize::from(place)).is_some_and(|it| it.of(marking) > 0)
        }) || self
            .ignored_where
            .iter()
            .any(|(ignored, need)| usize::from(*ignored) == event && self.holds(marking, need))
    }
}

/// The marking after something is added to it, modulo 2^64 in each word.
#[inline]
pub const fn plus<const W: usize>(marking: &[u64; W], delta: &[u64; W]) -> [u64; W] {
    let mut after = *marking;
    let mut word = 0;
    while word < W {
        after[word] = after[word].wrapping_add(delta[word]);
        word += 1;
    }
    after
}

/// Returns the marking less the tokens taken, all of which it has.
#[inline]
pub const fn minus<const W: usize>(marking: &[u64; W], take: &[u64; W]) -> [u64; W] {
    let mut left = *marking;
    let mut word = 0;
    while word < W {
        left[word] = left[word].wrapping_sub(take[word]);
        word += 1;
    }
    left
}

/// Returns the words at a position.
#[inline]
const fn words<const W: usize>(list: &[[u64; W]], at: usize) -> &[u64; W] {
    debug_assert!(at < list.len(), "the lists are of one system");
    if at < list.len() { &list[at] } else { &[0; W] }
}

/// The number of something of a component, given the first numbers of all components.
#[inline]
fn number(firsts: &[u16], component: u16, id: u32) -> Option<usize> {
    let (first, next) = bounds(firsts, usize::from(component));
    let number = first.checked_add(id as usize)?;
    (number < next).then_some(number)
}

/// The component of a number and what it is there.
#[inline]
fn of(firsts: &[u16], number: u16) -> (u16, u32) {
    if firsts.len() <= 2 {
        return (0, u32::from(number));
    }
    debug_assert!(firsts.is_sorted(), "the components in their order");
    let component = firsts.partition_point(|&first| first <= number).saturating_sub(1);
    let first = firsts.get(component).copied().unwrap_or(0);
    (component as u16, u32::from(number.saturating_sub(first)))
}

/// From the `at`-th of these numbers up to the next one.
#[inline]
pub(super) fn bounds(firsts: &[u16], at: usize) -> (usize, usize) {
    match (firsts.get(at), firsts.get(at.saturating_add(1))) {
        (Some(&first), Some(&next)) => (usize::from(first), usize::from(next)),
        _ => (0, 0),
    }
}
