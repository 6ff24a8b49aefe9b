//! Packs a system: how long its lists are, and what stands in them.

use super::code::{Clock, Entry, Lists, Mailbox, NONE, Route, Size, Words};
use super::data::{Delivery, Of, System, Target};
use crate::net::code::{Field, width_of};
use crate::net::{Arc, EventId, PlaceId, Role};

/// A field is appended; where it lies.
const fn place(used: &mut (u16, u8), width: u8) -> Field {
    if used.1 + width + 1 > 64 {
        *used = (used.0 + 1, 0);
    }
    let field = Field { word: used.0, shift: used.1, width };
    used.1 += width + 1;
    field
}

/// Whether a place has a field of its own: not a shared one, nor the complement of one.
const fn own(role: Role, places: &[crate::net::Place<'_>]) -> bool {
    match role {
        Role::Shared => false,
        Role::Complement(of) => !matches!(places[of.0 as usize].role, Role::Shared),
        _ => true,
    }
}

/// The complement of a place in its net.
pub(super) const fn complement(net: &crate::net::Net<'_>, of: PlaceId) -> Option<PlaceId> {
    let mut at = 0;
    while at < net.places.len() {
        if let Role::Complement(other) = net.places[at].role
            && other.0 == of.0
        {
            return Some(PlaceId(at as u32));
        }
        at += 1;
    }
    None
}

/// Whether a place is bound by some shared place and has no complement in its own net: the system
/// makes one.
const fn lacks_complement(system: &System<'_>, component: usize, at: usize) -> bool {
    let mut binding = 0;
    while binding < system.bindings.len() {
        if let Target::Place(owner) = system.bindings[binding].target
            && owner.component as usize == component
            && owner.id.0 as usize == at
        {
            return complement(system.components[component].net, owner.id).is_none();
        }
        binding += 1;
    }
    false
}

/// How long the lists will be; `None` when they are too long.
pub const fn size(system: &System<'_>) -> Option<Size> {
    let mut it = Size {
        words: 1,
        components: system.components.len(),
        entries: 0,
        takes: 0,
        rows: 0,
        routes: 0,
        mailboxes: 0,
        fields: 0,
        clocks: 0,
        clears: system.clears.len(),
        slots: 0,
    };
    let mut used = (0, 0);
    let mut component = 0;
    let mut events = 0;
    while component < system.components.len() {
        let net = system.components[component].net;
        let mut at = 0;
        while at < net.places.len() {
            if own(net.places[at].role, net.places) {
                place(&mut used, width_of(net.places[at].bound));
                if lacks_complement(system, component, at) {
                    place(&mut used, width_of(net.places[at].bound));
                }
            }
            at += 1;
        }
        it.fields += net.places.len();
        it.entries += net.transitions.len();
        events += net.events.len();
        let mut at = 0;
        while at < net.transitions.len() {
            it.clocks += net.transitions[at].within.is_some() as usize;
            it.routes += routes(system, component, net.transitions[at].emits);
            at += 1;
        }
        let mut at = 0;
        while at < net.events.len() {
            let of = Of { component: component as u16, id: EventId(at as u32) };
            if let Some(Delivery::Mail { capacity }) = system.delivery(of) {
                it.mailboxes += 1;
                it.slots += capacity as usize;
                place(&mut used, width_of(capacity as u32));
                place(&mut used, width_of(capacity as u32));
            }
            at += 1;
        }
        component += 1;
    }
    it.words = used.0 as usize + 1;
    it.takes = if it.clocks == 0 { 0 } else { it.entries };
    it.rows = events + system.components.len() + 2;
    let most = u16::MAX as usize - 1;
    let long = it.entries > most
        || it.rows > most
        || it.routes > most
        || it.slots > most
        || it.fields > most;
    if long { None } else { Some(it) }
}

/// To how many events these outputs go.
const fn routes(system: &System<'_>, component: usize, emits: &[crate::net::OutputId]) -> usize {
    let mut count = 0;
    let mut at = 0;
    while at < emits.len() {
        let mut link = 0;
        while link < system.links.len() {
            let from = system.links[link].from;
            count += (from.component as usize == component && from.id.0 == emits[at].0) as usize;
            link += 1;
        }
        at += 1;
    }
    count
}

/// Packs a system. The lists are as long as [`size`] says, `W` is [`Size::words`] or more, and the
/// system has no [`defect`](System::defect).
pub const fn pack<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) -> Words<W> {
    let mut words = Words { guards: [0; W], bounds: [0; W], initial: [0; W] };
    let mut extra = [Field { word: 0, shift: 0, width: 0 }; EXTRA];
    positions(system, lists);
    layout(system, lists, &mut words, &mut extra);
    let (mut row, mut entry, mut clock, mut route) = (0, 0, 0, 0);
    let mut kind = 0;
    // Three passes: what is on events, by net and event; what fires at once, by net; what fires in
    // an interval.
    while kind < 3 {
        let mut component = 0;
        while component < system.components.len() {
            let net = system.components[component].net;
            let mut event = 0;
            while event < if kind == 0 { net.events.len() } else { 1 } {
                if kind < 2 || component == 0 {
                    lists.rows[row] = entry as u16;
                    row += 1;
                }
                let first = lists.rows[row - 1] as usize;
                let mut at = 0;
                while at < net.transitions.len() {
                    let it = &net.transitions[at];
                    let belongs = match it.on {
                        Some(on) => kind == 0 && on.0 as usize == event,
                        None => kind == 1 + it.within.is_some() as usize,
                    };
                    if belongs {
                        let start = route;
                        route = add_routes(system, lists, component, it.emits, route);
                        let Moved { need, delta, .. } =
                            moved(system, lists.fields, lists.places, &extra, component, at);
                        lists.entries[entry] = Entry {
                            need,
                            delta,
                            component: component as u16,
                            transition: at as u16,
                            clock: NONE,
                            routes: (start as u16, route as u16),
                        };
                        insert(system, lists.entries, first, entry);
                        entry += 1;
                    }
                    at += 1;
                }
                event += 1;
            }
            component += 1;
        }
        kind += 1;
    }
    lists.rows[row] = entry as u16;
    let mut at = 0;
    while at < entry {
        if !lists.takes.is_empty() {
            let it = &lists.entries[at];
            let moved = moved(
                system,
                lists.fields,
                lists.places,
                &extra,
                it.component as usize,
                it.transition as usize,
            );
            lists.takes[at] = moved.take;
        }
        let it = &mut lists.entries[at];
        let transition =
            &system.components[it.component as usize].net.transitions[it.transition as usize];
        if let Some(within) = transition.within {
            let latest = match within.latest {
                Some(latest) => latest,
                None => u32::MAX,
            };
            it.clock = clock as u16;
            lists.clocks[clock] = Clock {
                entry: at as u16,
                event: transition.on.is_some(),
                earliest: within.earliest,
                latest,
            };
            clock += 1;
        }
        at += 1;
    }
    let mut at = 0;
    while at < system.clears.len() {
        let clear = system.clears[at];
        let on = lists.events[clear.on.component as usize] + clear.on.id.0 as u16;
        let emptied = lists.events[clear.on.component as usize] + clear.mailbox.0 as u16;
        lists.clears[at] = (on, mailbox_of(lists.mailboxes, emptied));
        at += 1;
    }
    words
}

/// The most places of which a system makes the complement.
const EXTRA: usize = 256;

/// Counts events and places over all nets.
const fn positions<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) {
    let (mut component, mut events, mut places) = (0, 0, 0);
    while component < system.components.len() {
        lists.events[component] = events;
        lists.places[component] = places;
        events += system.components[component].net.events.len() as u16;
        places += system.components[component].net.places.len() as u16;
        component += 1;
    }
    lists.events[component] = events;
    lists.places[component] = places;
}

/// Lays out all fields.
const fn layout<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    words: &mut Words<W>,
    extra: &mut [Field; EXTRA],
) {
    let (mut used, mut made, mut box_, mut slot) = ((0, 0), 0, 0, 0);
    let mut component = 0;
    while component < system.components.len() {
        let net = system.components[component].net;
        let mut at = 0;
        while at < net.places.len() {
            let it = net.places[at];
            if own(it.role, net.places) {
                let field = place(&mut used, width_of(it.bound));
                lists.fields[lists.places[component] as usize + at] = field;
                fill(words, field, it.initial, it.bound);
                if lacks_complement(system, component, at) {
                    let field = place(&mut used, width_of(it.bound));
                    extra[made] = field;
                    made += 1;
                    fill(words, field, it.bound - it.initial, it.bound);
                }
            }
            at += 1;
        }
        component += 1;
    }
    let mut component = 0;
    while component < system.components.len() {
        lists.turns[component] = box_ as u16;
        let mut at = 0;
        while at < system.components[component].net.events.len() {
            let of = Of { component: component as u16, id: EventId(at as u32) };
            if let Some(Delivery::Mail { capacity }) = system.delivery(of) {
                let width = width_of(capacity as u32);
                let (waiting, room) = (place(&mut used, width), place(&mut used, width));
                fill(words, waiting, 0, capacity as u32);
                fill(words, room, capacity as u32, capacity as u32);
                lists.mailboxes[box_] = Mailbox {
                    event: lists.events[component] + at as u16,
                    waiting,
                    room,
                    slot,
                    capacity,
                };
                box_ += 1;
                slot += capacity;
            }
            at += 1;
        }
        component += 1;
    }
    lists.turns[component] = box_ as u16;
    shared(system, lists, extra);
}

const fn fill<const W: usize>(words: &mut Words<W>, field: Field, initial: u32, bound: u32) {
    let word = field.word as usize;
    words.guards[word] |= 1 << (field.shift + field.width);
    words.bounds[word] |= field.tokens(bound);
    words.initial[word] |= field.tokens(initial);
}

/// Shared places, and their complements, lie where the places lie that they are bound to.
const fn shared<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    extra: &[Field; EXTRA],
) {
    let mut at = 0;
    while at < system.bindings.len() {
        let binding = system.bindings[at];
        let own = lists.places[binding.shared.component as usize] as usize;
        let (place, absence) = match binding.target {
            Target::Place(owner) => {
                let net = system.components[owner.component as usize].net;
                let first = lists.places[owner.component as usize] as usize;
                let absence = match complement(net, owner.id) {
                    Some(complement) => lists.fields[first + complement.0 as usize],
                    None => extra[extra_of(system, owner)],
                };
                (lists.fields[first + owner.id.0 as usize], absence)
            }
            Target::Mailbox(event) => {
                let event = lists.events[event.component as usize] + event.id.0 as u16;
                let mailbox = lists.mailboxes[mailbox_of(lists.mailboxes, event) as usize];
                (mailbox.waiting, mailbox.room)
            }
        };
        lists.fields[own + binding.shared.id.0 as usize] = place;
        if let Some(complement) =
            complement(system.components[binding.shared.component as usize].net, binding.shared.id)
        {
            lists.fields[own + complement.0 as usize] = absence;
        }
        at += 1;
    }
}

/// The number of the complement that the system makes for this place.
const fn extra_of(system: &System<'_>, owner: Of<PlaceId>) -> usize {
    let (mut made, mut component) = (0, 0);
    while component < system.components.len() {
        let net = system.components[component].net;
        let mut at = 0;
        while at < net.places.len() {
            if component == owner.component as usize && at == owner.id.0 as usize {
                return made;
            }
            made += (own(net.places[at].role, net.places)
                && lacks_complement(system, component, at)) as usize;
            at += 1;
        }
        component += 1;
    }
    made
}

const fn mailbox_of(mailboxes: &[Mailbox], event: u16) -> u16 {
    let mut at = 0;
    while at < mailboxes.len() {
        if mailboxes[at].event == event {
            return at as u16;
        }
        at += 1;
    }
    NONE
}

const fn add_routes<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    component: usize,
    emits: &[crate::net::OutputId],
    mut route: usize,
) -> usize {
    let mut at = 0;
    while at < emits.len() {
        let mut link = 0;
        while link < system.links.len() {
            let it = system.links[link];
            if it.from.component as usize == component && it.from.id.0 == emits[at].0 {
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
        at += 1;
    }
    route
}

/// What a transition asks for and does.
struct Moved<const W: usize> {
    need: [u64; W],
    take: [u64; W],
    delta: [u64; W],
}

const fn moved<const W: usize>(
    system: &System<'_>,
    fields: &[Field],
    places: &[u16],
    extra: &[Field; EXTRA],
    component: usize,
    at: usize,
) -> Moved<W> {
    let it = &system.components[component].net.transitions[at];
    let (mut need, mut give) = ([0; W], [0; W]);
    let first = places[component] as usize;
    add(&mut need, fields, first, it.take);
    let mut take = need;
    add(&mut need, fields, first, it.read);
    add(&mut give, fields, first, it.give);
    // Complements that the system makes follow their places, by what a transition changes in the
    // end.
    let mut arc = 0;
    while arc < it.take.len() + it.give.len() {
        let taken = arc < it.take.len();
        let place = if taken { it.take[arc].place } else { it.give[arc - it.take.len()].place };
        let owner = match system.target(Of { component: component as u16, id: place }) {
            Some(Target::Place(owner)) => owner,
            _ => Of { component: component as u16, id: place },
        };
        // Of a place that is taken and given the arc that takes counts for both.
        let counts = taken || weight(it.take, place) == 0;
        if counts
            && lacks_complement(system, owner.component as usize, owner.id.0 as usize)
            && !mirrored(system, component, owner, it)
        {
            let field = extra[extra_of(system, owner)];
            let word = field.word as usize;
            let (lost, gained) = (weight(it.take, place), weight(it.give, place));
            if lost > gained {
                give[word] += field.tokens(lost - gained);
            } else {
                need[word] += field.tokens(gained - lost);
                take[word] += field.tokens(gained - lost);
            }
        }
        arc += 1;
    }
    let mut delta = [0; W];
    let mut word = 0;
    while word < W {
        delta[word] = give[word].wrapping_sub(take[word]);
        word += 1;
    }
    Moved { need, take, delta }
}

/// Whether a transition of another net, which shares the place, moves the complement itself.
const fn mirrored(
    system: &System<'_>,
    component: usize,
    owner: Of<PlaceId>,
    it: &crate::net::Transition<'_>,
) -> bool {
    if owner.component as usize == component {
        return false;
    }
    let net = system.components[component].net;
    let mut arc = 0;
    while arc < it.take.len() + it.give.len() {
        let place = if arc < it.take.len() {
            it.take[arc].place
        } else {
            it.give[arc - it.take.len()].place
        };
        if let Role::Complement(of) = net.places[place.0 as usize].role
            && let Some(Target::Place(target)) =
                system.target(Of { component: component as u16, id: of })
            && target.component == owner.component
            && target.id.0 == owner.id.0
        {
            return true;
        }
        arc += 1;
    }
    false
}

/// The weight of a place among arcs.
const fn weight(arcs: &[Arc], place: PlaceId) -> u32 {
    let mut at = 0;
    while at < arcs.len() {
        if arcs[at].place.0 == place.0 {
            return arcs[at].weight;
        }
        at += 1;
    }
    0
}

const fn add<const W: usize>(sum: &mut [u64; W], fields: &[Field], first: usize, arcs: &[Arc]) {
    let mut at = 0;
    while at < arcs.len() {
        let field = fields[first + arcs[at].place.0 as usize];
        let guard = 1 << field.width;
        let weight = if arcs[at].weight > guard { guard } else { arcs[at].weight };
        sum[field.word as usize] += field.tokens(weight);
        at += 1;
    }
}

/// Moves the last entry of a row to where its priority belongs.
const fn insert<const W: usize>(
    system: &System<'_>,
    entries: &mut [Entry<W>],
    first: usize,
    last: usize,
) {
    let mut at = last;
    while at > first && priority(system, &entries[at - 1]) < priority(system, &entries[at]) {
        let before = entries[at - 1];
        entries[at - 1] = entries[at];
        entries[at] = before;
        at -= 1;
    }
}

const fn priority<const W: usize>(system: &System<'_>, entry: &Entry<W>) -> i16 {
    system.components[entry.component as usize].net.transitions[entry.transition as usize].priority
}
