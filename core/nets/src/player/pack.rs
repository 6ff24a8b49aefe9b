//! Packs a system: fills its lists.

use super::arcs::{Moved, asked, moved};
use super::code::{Clock, Lists, NONE, Route, Words};
use super::fingerprint::fingerprint;
use super::kept;
use super::layout::{layout, mailbox_of};
use super::machine::{machine, needs_state};
use crate::net::data::{EventId, OutputId};
use crate::system::data::{Delivery, Of, System};

/// The bits of a hash of needs and deltas.
const HASH_BITS: u32 = 12;

/// So many slots from that of its hash on are looked through for equal words: the time of packing
/// is linear.
const PROBES: usize = 16;

/// The positions of words by their hash, each in the first free slot from there on, or [`NONE`].
type Slots = [u16; 1 << HASH_BITS];

const FREE: Slots = [NONE; 1 << HASH_BITS];

/// Packs a system. The lists are as long as [`size`](super::size::size) says, `W` is
/// [`Size::words`](super::code::Size::words) or more, and the system and its nets have no defect.
/// Needs and deltas may be fewer: the words say how many.
pub const fn pack<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) -> Words<W> {
    let (states, control) = machine(system);
    let mut words = Words { states: states as u16, ..Words::NOTHING };
    words.fingerprint = fingerprint(system);
    count(system, lists);
    layout(system, lists, &mut words);
    if control {
        let mut at = 0;
        while at < states {
            words.control |= lists.fields[at].tokens(1);
            at += 1;
        }
    }
    entries(system, lists, states, control);
    arcs(system, lists, &mut words);
    words.restless = restless(system, lists, &words);
    clocks(system, lists);
    say(system, lists);
    ignore(system, lists);
    kept::keep(system, lists);
    words
}

/// Counts events, transitions and places over all nets.
const fn count<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) {
    let (mut component, mut events, mut transitions, mut places) = (0, 0, 0, 0);
    while component < system.components.len() {
        lists.events[component] = events;
        lists.transitions[component] = transitions;
        lists.places[component] = places;
        let net = system.components[component].net;
        events += net.events.len() as u16;
        transitions += net.transitions.len() as u16;
        places += net.places.len() as u16;
        component += 1;
    }
    lists.events[component] = events;
    lists.transitions[component] = transitions;
    lists.places[component] = places;
}

/// A kind of transitions of some components.
#[derive(Clone, Copy)]
enum Kind {
    On(EventId),
    AtOnce,
    InTime,
}

/// Rows of entries.
const fn entries<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    states: usize,
    control: bool,
) {
    let count = system.components.len();
    let mut done = (0, 0);
    let mut component = 0;
    while component < count {
        let mut event = 0;
        while event < system.components[component].net.events.len() {
            let on = Kind::On(EventId(event as u32));
            done = rows(system, lists, (component, component + 1), on, states, control, done);
            event += 1;
        }
        component += 1;
    }
    component = 0;
    while component < count {
        let of = (component, component + 1);
        done = rows(system, lists, of, Kind::AtOnce, states, control, done);
        component += 1;
    }
    done = rows(system, lists, (0, count), Kind::InTime, states, control, done);
    let all = done.0 == lists.entries.len() && done.1 == lists.rows.len();
    debug_assert!(all, "each transition and each kind is listed");
}

/// The rows of a kind: one for each state, or one for all of them where a transition fires in any.
/// Takes how many entries and numbers of rows there are, and says how many there are then.
const fn rows<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    of: (usize, usize),
    kind: Kind,
    states: usize,
    control: bool,
    done: (usize, usize),
) -> (usize, usize) {
    let (mut entry, mut row) = done;
    let apart = control && is_by_state(system, kind, states);
    let (mut first, mut state) = (entry, 0);
    while state < states {
        if state == 0 || apart {
            first = entry;
            let mut component = of.0;
            while component < of.1 {
                let net = system.components[component].net;
                let mut at = 0;
                while at < net.transitions.len() {
                    let it = &net.transitions[at];
                    if is_of(it, kind) && (!apart || needs_state(it, state)) {
                        lists.entries[entry].transition = lists.transitions[component] + at as u16;
                        insert(system, lists, first, entry);
                        entry += 1;
                    }
                    at += 1;
                }
                component += 1;
            }
        }
        lists.rows[row] = if first < entry { first as u16 } else { NONE };
        lists.rows[row + 1] = entry as u16;
        row += 2;
        state += 1;
    }
    (entry, row)
}

const fn is_of(it: &crate::net::data::Transition<'_>, kind: Kind) -> bool {
    match (it.on, kind) {
        (Some(on), Kind::On(event)) => on.0 == event.0,
        (None, Kind::AtOnce) => it.within.is_none(),
        (None, Kind::InTime) => it.within.is_some(),
        _ => false,
    }
}

/// Whether every transition of this kind of a state machine needs one of its states.
const fn is_by_state(system: &System<'_>, kind: Kind, states: usize) -> bool {
    let net = system.components[0].net;
    let mut at = 0;
    while at < net.transitions.len() {
        let it = &net.transitions[at];
        if is_of(it, kind) {
            let mut state = 0;
            while state < states && !needs_state(it, state) {
                state += 1;
            }
            if state == states {
                return false;
            }
        }
        at += 1;
    }
    true
}

/// Moves the last entry of a row to where its priority belongs.
const fn insert<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    first: usize,
    last: usize,
) {
    let this = lists.entries[last];
    let priority = transition(system, lists.transitions, this.transition).priority;
    let mut at = last;
    while at > first {
        let before = lists.entries[at - 1];
        if transition(system, lists.transitions, before.transition).priority >= priority {
            return;
        }
        lists.entries[at] = before;
        lists.entries[at - 1] = this;
        at -= 1;
    }
}

/// The component of a number.
const fn component(firsts: &[u16], number: u16) -> usize {
    let mut component = 0;
    while component + 2 < firsts.len() && firsts[component + 1] <= number {
        component += 1;
    }
    component
}

/// The transition of a number.
const fn transition<'s>(
    system: &System<'s>,
    firsts: &[u16],
    number: u16,
) -> &'s crate::net::data::Transition<'s> {
    let component = component(firsts, number);
    &system.components[component].net.transitions[(number - firsts[component]) as usize]
}

/// The words of the entries.
const fn arcs<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>, words: &mut Words<W>) {
    let (mut needs, mut deltas): (Slots, Slots) = (FREE, FREE);
    let mut at = 0;
    while at < lists.entries.len() {
        let number = lists.entries[at].transition;
        let component = component(lists.transitions, number);
        let of = (number - lists.transitions[component]) as usize;
        let Moved { need, delta, take } = moved(system, lists, component, of);
        if !lists.takes.is_empty() {
            lists.takes[number as usize] = take;
        }
        lists.entries[at].need = once(lists.needs, &mut words.needs, &need, &mut needs);
        lists.entries[at].delta = once(lists.deltas, &mut words.deltas, &delta, &mut deltas);
        at += 1;
    }
}

/// The position of these words in a list of so many, to which they are added unless equal ones are
/// found. Single words are always added: they are as short as a position, and found without one.
const fn once<const W: usize>(
    list: &mut [[u64; W]],
    count: &mut u16,
    words: &[u64; W],
    slots: &mut Slots,
) -> u16 {
    let end = *count;
    if W > 1 {
        let (mut hash, mut word) = (0, 0);
        while word < W {
            hash = (hash ^ words[word]).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            hash ^= hash >> 32;
            word += 1;
        }
        let first = hash as usize % slots.len();
        let mut probe = 0;
        while probe < PROBES {
            let slot = &mut slots[(first + probe) % slots.len()];
            if *slot == NONE {
                *slot = end;
                break;
            }
            let before = &list[*slot as usize];
            word = 0;
            while word < W && before[word] == words[word] {
                word += 1;
            }
            if word == W {
                return *slot;
            }
            probe += 1;
        }
    }
    list[end as usize] = *words;
    *count += 1;
    end
}

/// See [`Words::restless`]: the first place that each transition needs which fires at once by
/// itself.
const fn restless<const W: usize>(
    system: &System<'_>,
    lists: &Lists<'_, W>,
    words: &Words<W>,
) -> [u64; W] {
    let mut restless = [0; W];
    let mut at = 0;
    while at < lists.entries.len() {
        let entry = &lists.entries[at];
        let it = transition(system, lists.transitions, entry.transition);
        if is_of(it, Kind::AtOnce) {
            let mut field = 0;
            let need = &lists.needs[entry.need as usize];
            while field < lists.fields.len() && lists.fields[field].of(need) == 0 {
                field += 1;
            }
            if field < lists.fields.len() {
                let field = lists.fields[field];
                restless[field.word as usize] |= field.mask() << field.shift;
            } else {
                restless[0] |= words.guards[0];
            }
        }
        at += 1;
    }
    restless
}

/// Clocks, in the order of the entries.
const fn clocks<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) {
    let (mut at, mut clock) = (0, 0);
    while at < lists.entries.len() {
        let it = transition(system, lists.transitions, lists.entries[at].transition);
        if let Some(within) = it.within {
            let latest = match within.latest {
                Some(latest) => latest,
                None => u32::MAX,
            };
            lists.entries[at].clock = clock as u16;
            lists.clocks[clock] = Clock {
                need: lists.needs[lists.entries[at].need as usize],
                entry: at as u16,
                event: it.on.is_some(),
                earliest: within.earliest,
                latest,
            };
            clock += 1;
        }
        at += 1;
    }
    debug_assert!(clock == lists.clocks.len(), "each interval is listed");
}

/// Routes, by transition, and what is cleared.
const fn say<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) {
    let (mut number, mut route, mut component) = (0, 0, 0);
    while component < system.components.len() && !lists.says.is_empty() {
        let net = system.components[component].net;
        let mut at = 0;
        while at < net.transitions.len() {
            lists.says[number] = route as u16;
            number += 1;
            let mut said = 0;
            while said < net.transitions[at].emits.len() {
                let from = Of { component: component as u16, id: net.transitions[at].emits[said] };
                route = follow(system, lists, from, route);
                said += 1;
            }
            at += 1;
        }
        component += 1;
    }
    debug_assert!(route == lists.routes.len(), "each link is listed");
    if !lists.says.is_empty() {
        lists.says[number] = route as u16;
    }
    let mut at = 0;
    while at < system.clears.len() {
        let clear = system.clears[at];
        let first = lists.events[clear.on.component as usize];
        let emptied = mailbox_of(lists.mailboxes, first + clear.mailbox.0 as u16);
        debug_assert!(emptied != NONE, "a mailbox is emptied");
        lists.clears[at] = (first + clear.on.id.0 as u16, emptied);
        at += 1;
    }
}

/// Adds the routes of an output; how many there are then.
const fn follow<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    from: Of<OutputId>,
    mut route: usize,
) -> usize {
    let mut link = 0;
    while link < system.links.len() {
        let it = system.links[link];
        if it.from.component == from.component && it.from.id.0 == from.id.0 {
            let event = lists.events[it.to.component as usize] + it.to.id.0 as u16;
            let mailbox = match it.delivery {
                Delivery::Now => NONE,
                Delivery::Mail { .. } => mailbox_of(lists.mailboxes, event),
            };
            lists.routes[route] = Route { event, mailbox };
            route += 1;
        }
        link += 1;
    }
    route
}

/// Packs the events that places ignore on purpose.
const fn ignore<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) {
    let (mut component, mut count, mut guarded) = (0, 0, 0);
    while component < system.components.len() {
        let ignored = system.components[component].net.ignored;
        let mut at = 0;
        while at < ignored.len() {
            let it = &ignored[at];
            let event = lists.events[component] + it.event.0 as u16;
            if it.guard.is_empty() {
                let place = lists.places[component] + it.place.0 as u16;
                lists.ignored[count] = (event, place);
                count += 1;
            } else {
                lists.ignored_where[guarded] = (event, asked(lists, component, it));
                guarded += 1;
            }
            at += 1;
        }
        component += 1;
    }
    debug_assert!(count == lists.ignored.len() && guarded == lists.ignored_where.len(), "all");
}
