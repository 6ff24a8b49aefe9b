//! A net packed for execution: a marking is a few machine words, a transition a comparison and a sum.
//!
//! Every place is a field of a word, wide enough for its bound, with one guard bit above it. A transition is enabled
//! when `((marking | guards) - need) & guards == guards`: one subtraction compares all fields of a word at once, and a
//! field that holds too little borrows its own guard bit and nothing else's. Firing adds a word.

use super::data::{EventId, Net, PlaceId, Role, TransitionId};

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

/// Where a place lies in a marking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// The word.
    pub word: u16,
    /// The lowest bit.
    pub shift: u8,
    /// Bits for tokens; the guard bit is above them.
    pub width: u8,
}

impl Field {
    /// This many tokens in the word of the field.
    pub const fn tokens(self, tokens: u32) -> u64 {
        (tokens as u64) << self.shift
    }

    /// Its tokens in a marking.
    #[inline]
    pub const fn of<const W: usize>(self, marking: &[u64; W]) -> u32 {
        if (self.word as usize) < W {
            (marking[self.word as usize].wrapping_shr(self.shift as u32) & self.mask()) as u32
        } else {
            0
        }
    }

    /// All tokens that it can hold, at the lowest bits.
    pub(super) const fn mask(self) -> u64 {
        1_u64.wrapping_shl(self.width as u32).wrapping_sub(1)
    }
}

/// A net packed for execution. Lists are borrowed: from flash, or from the heap.
#[derive(Clone, Copy, Debug)]
pub struct Code<'c, const W: usize> {
    /// Transitions by event, then by the state that they need, then in the order in which they are tried.
    pub entries: &'c [Entry<W>],
    /// Where the transitions of an event that a state enables begin and end in `entries`: two numbers, at
    /// `2 * (event * states + state)`; a row without any begins at [`NO_ROW`]. After those of the last event come those
    /// that fire at once by themselves, then those that fire by themselves in an interval.
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
    /// The bits of the places of which exactly one is marked at any time; zero when the net has none such.
    pub control: u64,
    /// How many such places; one when there is none.
    pub states: u16,
    /// How many events.
    pub events: u16,
    /// The most transitions that fire at once by themselves one after another.
    pub settle: u32,
    /// Where nothing of this is marked, no transition fires at once by itself: a place of each of them, or the guard bit
    /// of one that needs no place.
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

/// The largest bound of a field; a place without a bound gets it.
pub const LARGEST: u32 = 65_535;

const fn bound(net: &Net<'_>, place: usize) -> u32 {
    let bound = net.places[place].bound;
    let bound = if bound > LARGEST { LARGEST } else { bound };
    if bound == 0 { 1 } else { bound }
}

/// How many bits hold this many tokens.
pub(crate) const fn width_of(bound: u32) -> u8 {
    let bound = if bound > LARGEST { LARGEST } else { bound };
    if bound == 0 { 1 } else { width(bound) }
}

const fn width(bound: u32) -> u8 {
    (u32::BITS - bound.leading_zeros()) as u8
}

/// How long the lists will be; `None` when the net has more than 65,534 transitions, events or places.
pub const fn size(net: &Net<'_>) -> Option<CodeSize> {
    let limit = u16::MAX as usize - 2;
    if net.transitions.len() > limit || net.events.len() > limit || net.places.len() > limit {
        return None;
    }
    let (mut words, mut used) = (1, 0);
    let mut at = 0;
    while at < net.places.len() {
        let bits = width(bound(net, at)) as u32 + 1;
        if used + bits > 64 {
            words += 1;
            used = 0;
        }
        used += bits;
        at += 1;
    }
    let mut clocks = 0;
    let mut at = 0;
    while at < net.transitions.len() {
        clocks += net.transitions[at].within.is_some() as usize;
        at += 1;
    }
    let rows = 2 * (net.events.len() + 2) * control(net).0;
    let (entries, fields, events) = (net.transitions.len(), net.places.len(), net.events.len());
    Some(CodeSize { words, entries, rows, clocks, fields, events })
}

/// How many states the net has when it is a state machine over its `Role::State` places (one otherwise), and whether
/// it is one: there is one token in them, and every transition moves it, reads it or leaves it alone.
const fn control(net: &Net<'_>) -> (usize, bool) {
    let mut states = 0;
    let mut tokens = 0;
    while states < net.places.len() && matches!(net.places[states].role, Role::State) {
        if bound(net, states) != 1 {
            return (1, false);
        }
        tokens += net.places[states].initial;
        states += 1;
    }
    // Two bits each, all in the first word.
    if states == 0 || states > 32 || tokens != 1 {
        return (1, false);
    }
    let mut at = 0;
    while at < net.transitions.len() {
        let it = &net.transitions[at];
        let (taken, read, given) = (among(it.take, states), among(it.read, states), among(it.give, states));
        if !(taken == 1 && read == 0 && given == 1 || taken == 0 && read <= 1 && given == 0) {
            return (1, false);
        }
        at += 1;
    }
    (states, true)
}

/// How many of these arcs go to the first places.
const fn among(arcs: &[super::Arc], places: usize) -> usize {
    let mut count = 0;
    let mut at = 0;
    while at < arcs.len() {
        count += ((arcs[at].place.0 as usize) < places) as usize;
        at += 1;
    }
    count
}

/// Whether exactly one place of role [`Role::State`] is marked at any time, because transitions only move one token
/// among them.
pub const fn is_state_machine(net: &Net<'_>) -> bool {
    control(net).1
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

/// Packs a net. The lists are as long as [`size`] says, `W` is [`CodeSize::words`] or more, and the net has no
/// [`defect`](Net::defect).
pub const fn pack<const W: usize>(net: &Net<'_>, lists: &mut Lists<'_, W>) -> Words<W> {
    let (states, machine) = control(net);
    let mut words = Words {
        guards: [0; W],
        bounds: [0; W],
        initial: [0; W],
        control: 0,
        states: states as u16,
        fingerprint: fingerprint(net),
    };
    let (mut word, mut used) = (0, 0);
    let mut at = 0;
    while at < net.places.len() {
        let width = width(bound(net, at));
        if used + width + 1 > 64 {
            word += 1;
            used = 0;
        }
        let field = Field { word, shift: used, width };
        lists.fields[at] = field;
        let word = word as usize;
        words.guards[word] |= 1 << (used + width);
        words.bounds[word] |= field.tokens(bound(net, at));
        words.initial[word] |= field.tokens(net.places[at].initial);
        if machine && at < states {
            words.control |= field.tokens(1);
        }
        used += width + 1;
        at += 1;
    }
    let mut at = 0;
    while at < net.ignored.len() {
        let field = lists.fields[net.ignored[at].place.0 as usize];
        let mask = ((1_u64 << field.width) - 1) << field.shift;
        lists.ignored[net.ignored[at].event.0 as usize][field.word as usize] |= mask;
        at += 1;
    }
    let (mut entry, mut first, mut clock, mut row) = (0, 0, 0, 0);
    let mut kind = 0;
    while kind < net.events.len() + 2 {
        // One row for each state; one row for all of them where a transition fires in any.
        let apart = machine && is_by_state(net, kind, states);
        let mut state = 0;
        while state < states {
            if state == 0 || apart {
                first = entry;
                let mut at = 0;
                while at < net.transitions.len() {
                    if kind_of(net, at) == kind && (!apart || needs(net, at, state)) {
                        lists.entries[entry] = packed(net, lists.fields, at);
                        insert(lists.entries, net, first, entry);
                        entry += 1;
                    }
                    at += 1;
                }
            }
            lists.rows[row] = if first < entry { first as u16 } else { NO_ROW };
            lists.rows[row + 1] = entry as u16;
            row += 2;
            state += 1;
        }
        kind += 1;
    }
    let mut at = 0;
    while at < entry {
        let transition = &net.transitions[lists.entries[at].transition as usize];
        lists.takes[lists.entries[at].transition as usize] = sum(transition.take, lists.fields);
        lists.order[at] = at as u16;
        let mut place = at;
        while place > 0 && goes_before(net, lists.entries, lists.order[place], lists.order[place - 1]) {
            (lists.order[place], lists.order[place - 1]) = (lists.order[place - 1], lists.order[place]);
            place -= 1;
        }
        at += 1;
    }
    at = 0;
    while at < entry {
        let timed = lists.order[at] as usize;
        let transition = &net.transitions[lists.entries[timed].transition as usize];
        if let Some(within) = transition.within {
            let latest = match within.latest {
                Some(latest) => latest,
                None => u32::MAX,
            };
            let event = transition.on.is_some();
            lists.clocks[clock] = Clock { entry: timed as u16, event, earliest: within.earliest, latest };
            lists.entries[timed].clock = clock as u16;
            clock += 1;
        }
        at += 1;
    }
    words
}

/// The row of a transition: its event, or one of the two rows of those that fire by themselves.
const fn kind_of(net: &Net<'_>, at: usize) -> usize {
    let it = &net.transitions[at];
    match it.on {
        Some(event) => event.0 as usize,
        None => net.events.len() + it.within.is_some() as usize,
    }
}

/// Whether every transition of this kind needs one of the states.
const fn is_by_state(net: &Net<'_>, kind: usize, states: usize) -> bool {
    let mut at = 0;
    while at < net.transitions.len() {
        let it = &net.transitions[at];
        if kind_of(net, at) == kind && among(it.take, states) + among(it.read, states) == 0 {
            return false;
        }
        at += 1;
    }
    true
}

const fn needs(net: &Net<'_>, at: usize, state: usize) -> bool {
    let it = &net.transitions[at];
    has(it.take, state) || has(it.read, state)
}

const fn has(arcs: &[super::Arc], place: usize) -> bool {
    let mut at = 0;
    while at < arcs.len() {
        if arcs[at].place.0 as usize == place {
            return true;
        }
        at += 1;
    }
    false
}

const fn sum<const W: usize>(arcs: &[super::Arc], fields: &[Field]) -> [u64; W] {
    let mut words = [0; W];
    let mut at = 0;
    while at < arcs.len() {
        let field = fields[arcs[at].place.0 as usize];
        words[field.word as usize] += field.tokens(clamped(arcs[at].weight, field));
        at += 1;
    }
    words
}

/// See [`Code::restless`]: the first place that each transition needs which fires at once by itself.
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

/// A weight beyond the field becomes its guard bit: as a need it is never met, as a gift it exceeds the bound.
const fn clamped(weight: u32, field: Field) -> u32 {
    let guard = 1 << field.width;
    if weight > guard { guard } else { weight }
}

const fn packed<const W: usize>(net: &Net<'_>, fields: &[Field], at: usize) -> Entry<W> {
    let it = &net.transitions[at];
    let (take, read, give): ([u64; W], [u64; W], [u64; W]) =
        (sum(it.take, fields), sum(it.read, fields), sum(it.give, fields));
    let mut entry = Entry { need: take, delta: give, transition: at as u16, clock: NO_CLOCK };
    let mut word = 0;
    while word < W {
        entry.need[word] += read[word];
        entry.delta[word] = give[word].wrapping_sub(take[word]);
        word += 1;
    }
    entry
}

/// Moves the last entry of a row to where its priority belongs.
const fn insert<const W: usize>(entries: &mut [Entry<W>], net: &Net<'_>, first: usize, last: usize) {
    let mut at = last;
    while at > first {
        let (before, this) = (entries[at - 1], entries[at]);
        let lower = net.transitions[before.transition as usize].priority;
        if lower >= net.transitions[this.transition as usize].priority {
            return;
        }
        entries[at - 1] = this;
        entries[at] = before;
        at -= 1;
    }
}

/// Whether an entry is tried before another one.
const fn goes_before<const W: usize>(net: &Net<'_>, entries: &[Entry<W>], a: u16, b: u16) -> bool {
    let (a, b) = (entries[a as usize].transition as usize, entries[b as usize].transition as usize);
    let (high, low) = (net.transitions[a].priority, net.transitions[b].priority);
    high > low || high == low && a < b
}

/// FNV-1a over everything that a stored marking depends on.
const fn fingerprint(net: &Net<'_>) -> u64 {
    let mut hash = text(0xcbf2_9ce4_8422_2325, net.name);
    let mut at = 0;
    while at < net.places.len() {
        hash = number(text(hash, net.places[at].name), net.places[at].bound);
        at += 1;
    }
    let mut at = 0;
    while at < net.transitions.len() {
        let it = &net.transitions[at];
        hash = text(hash, it.name);
        hash = number(hash, if let Some(event) = it.on { event.0 } else { u32::MAX });
        hash = arcs(arcs(arcs(hash, it.take), it.read), it.give);
        if let Some(within) = it.within {
            hash = number(
                number(hash, within.earliest),
                if let Some(latest) = within.latest { latest } else { u32::MAX },
            );
        }
        at += 1;
    }
    hash
}

const fn byte(hash: u64, byte: u8) -> u64 {
    (hash ^ byte as u64).wrapping_mul(0x0000_0100_0000_01b3)
}

const fn number(mut hash: u64, number: u32) -> u64 {
    let bytes = number.to_le_bytes();
    let mut at = 0;
    while at < bytes.len() {
        hash = byte(hash, bytes[at]);
        at += 1;
    }
    hash
}

const fn text(mut hash: u64, text: &str) -> u64 {
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        hash = byte(hash, bytes[at]);
        at += 1;
    }
    byte(hash, 0xff)
}

const fn arcs(mut hash: u64, arcs: &[super::Arc]) -> u64 {
    let mut at = 0;
    while at < arcs.len() {
        hash = number(number(hash, arcs[at].place.0), arcs[at].weight);
        at += 1;
    }
    byte(hash, 0xfe)
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

    /// The first transition of an event, or of a kind beyond the events, that may be enabled in this marking and `can`.
    #[inline]
    pub fn first(
        &self,
        kind: usize,
        marking: &[u64; W],
        can: impl Fn(&Entry<W>) -> bool,
    ) -> Option<&'c Entry<W>> {
        let row = 2 * kind * usize::from(self.states) + self.control_bit(marking);
        let Some(&[start, end]) = self.rows.get(row..row + 2) else { return None };
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

    /// All transitions of an event, or of the kind after the events: those that fire at once by themselves, or of the
    /// kind after that: those that do in an interval.
    pub fn kind(&self, kind: usize) -> &'c [Entry<W>] {
        // Where the last row of a kind ends the first one of the next begins.
        let end = |kinds: usize| {
            let row = kinds.checked_mul(2 * usize::from(self.states))?.checked_sub(1)?;
            Some(usize::from(*self.rows.get(row)?))
        };
        let entries =
            end(kind.saturating_add(1)).and_then(|last| self.entries.get(end(kind).unwrap_or(0)..last));
        entries.unwrap_or(&[])
    }

    /// The position of the marked place of a state machine.
    #[inline]
    pub fn state(&self, marking: &[u64; W]) -> usize {
        self.control_bit(marking) / 2
    }

    /// The bit of the marked place of a state machine: twice its position. Zero for a net that is none.
    #[inline]
    fn control_bit(&self, marking: &[u64; W]) -> usize {
        let marked = marking.first().map_or(0, |word| word & self.control);
        // Most have up to sixteen states: half a word, for which small processors need half the instructions.
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
    pub fn urgent(&self, marking: &[u64; W], can: impl Fn(&Entry<W>) -> bool) -> Option<&'c Entry<W>> {
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

    /// The marking after firing, whatever the bounds; a field that exceeds its bound does not disturb others.
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

/// The lists of a [`Code`] whose lengths are known when compiling, those first that every event needs.
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
            clocks: [Clock { entry: 0, event: false, earliest: 0, latest: 0 }; C],
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
        Code::new(Borrowed { entries, takes, order, rows, clocks, fields, ignored }, words, settle, bounded)
    }
}
