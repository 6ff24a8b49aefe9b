//! Packs a net: how long its lists are, and what stands in them.

use super::field::{Field, LARGEST, width};
use super::fingerprint::fingerprint;
use super::{Clock, CodeSize, Entry, Lists, NO_CLOCK, NO_ROW, Words};
use crate::net::data::{Arc, Net, Role};

const fn bound(net: &Net<'_>, place: usize) -> u32 {
    let bound = net.places[place].bound;
    let bound = if bound > LARGEST { LARGEST } else { bound };
    if bound == 0 { 1 } else { bound }
}

/// How long the lists will be; `None` when the net has more than 65,534 transitions, events or
/// places.
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

/// How many states the net has when it is a state machine over its `Role::State` places (one
/// otherwise), and whether it is one: there is one token in them, and every transition moves it,
/// reads it or leaves it alone.
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
        let (taken, read, given) =
            (among(it.take, states), among(it.read, states), among(it.give, states));
        if !(taken == 1 && read == 0 && given == 1 || taken == 0 && read <= 1 && given == 0) {
            return (1, false);
        }
        at += 1;
    }
    (states, true)
}

/// How many of these arcs go to the first places.
const fn among(arcs: &[Arc], places: usize) -> usize {
    let mut count = 0;
    let mut at = 0;
    while at < arcs.len() {
        count += ((arcs[at].place.0 as usize) < places) as usize;
        at += 1;
    }
    count
}

/// Whether exactly one place of role [`Role::State`] is marked at any time, because transitions
/// only move one token among them.
pub const fn is_state_machine(net: &Net<'_>) -> bool {
    control(net).1
}

/// Packs a net. The lists are as long as [`size`] says, `W` is [`CodeSize::words`] or more, and the
/// net has no [`defect`](Net::defect).
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
        while place > 0
            && goes_before(net, lists.entries, lists.order[place], lists.order[place - 1])
        {
            (lists.order[place], lists.order[place - 1]) =
                (lists.order[place - 1], lists.order[place]);
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
            let (entry, need, earliest) =
                (timed as u16, lists.entries[timed].need, within.earliest);
            lists.clocks[clock] = Clock { need, entry, event, earliest, latest };
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

const fn has(arcs: &[Arc], place: usize) -> bool {
    let mut at = 0;
    while at < arcs.len() {
        if arcs[at].place.0 as usize == place {
            return true;
        }
        at += 1;
    }
    false
}

const fn sum<const W: usize>(arcs: &[Arc], fields: &[Field]) -> [u64; W] {
    let mut words = [0; W];
    let mut at = 0;
    while at < arcs.len() {
        let field = fields[arcs[at].place.0 as usize];
        words[field.word as usize] += field.tokens(clamped(arcs[at].weight, field));
        at += 1;
    }
    words
}

/// A weight beyond the field becomes its guard bit: as a need it is never met, as a gift it exceeds
/// the bound.
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
const fn insert<const W: usize>(
    entries: &mut [Entry<W>],
    net: &Net<'_>,
    first: usize,
    last: usize,
) {
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
