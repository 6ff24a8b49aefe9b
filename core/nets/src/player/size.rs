//! The lengths of the lists of a packed system.

use super::code::Size;
use super::kept;
use super::layout::{Used, asks_for_room, lacks_complement, owns};
use super::machine::machine;
use crate::net::data::{EventId, OutputId};
use crate::system::data::{Delivery, Of, System};

/// The most of anything that a packed system counts.
const MOST: usize = u16::MAX as usize - 1;

/// How long the lists will be, those of needs and deltas at most; `None` when one is longer than
/// 65,534.
pub const fn size(system: &System<'_>) -> Option<Size> {
    let mut it = Size {
        words: 1,
        components: system.components.len(),
        entries: 0,
        needs: 0,
        deltas: 0,
        takes: 0,
        rows: 0,
        routes: 0,
        says: 0,
        mailboxes: 0,
        fields: 0,
        complements: 0,
        clocks: 0,
        clears: system.clears.len(),
        ignored: 0,
        ignored_where: 0,
        kept: 0,
        summands: 0,
        slots: 0,
    };
    let mut used = Used::NOTHING;
    let (mut component, mut events) = (0, 0);
    while component < system.components.len() {
        let net = system.components[component].net;
        it.fields += net.places.len();
        it.entries += net.transitions.len();
        it.ignored += net.ignored.len();
        let (kept, summands) = kept::count(net);
        it.kept += kept;
        it.summands += summands;
        events += net.events.len();
        if it.fields > MOST || it.entries > MOST || it.ignored > MOST || events > MOST {
            return None;
        }
        let mut at = 0;
        while at < net.ignored.len() {
            it.ignored_where += !net.ignored[at].guard.is_empty() as usize;
            at += 1;
        }
        at = 0;
        while at < net.places.len() {
            if owns(system, component, at) {
                used.place(net.places[at].bound);
                if lacks_complement(system, component, at) {
                    used.place(net.places[at].bound);
                    it.complements += 1;
                }
            }
            at += 1;
        }
        let mut at = 0;
        while at < net.transitions.len() {
            it.clocks += net.transitions[at].within.is_some() as usize;
            it.routes += routes(system, component, net.transitions[at].emits);
            at += 1;
        }
        component += 1;
    }
    component = 0;
    while component < system.components.len() {
        let mut at = 0;
        while at < system.components[component].net.events.len() {
            let of = Of { component: component as u16, id: EventId(at as u32) };
            if let Some(Delivery::Mail { capacity }) = system.delivery(of) {
                it.mailboxes += 1;
                it.slots += capacity as usize;
                used.place(capacity as u32);
                if asks_for_room(system, of) {
                    used.place(capacity as u32);
                }
            }
            at += 1;
        }
        component += 1;
    }
    it.ignored -= it.ignored_where;
    it.words = used.words();
    (it.needs, it.deltas) = (it.entries, it.entries);
    it.takes = if it.clocks == 0 { 0 } else { it.entries };
    it.says = if it.routes == 0 { 0 } else { it.entries + 1 };
    it.rows = 2 * (events + system.components.len() + 1) * machine(system).0;
    let long = it.rows > MOST || it.routes > MOST || it.slots > MOST || it.summands > MOST;
    if long { None } else { Some(it) }
}

/// [`size`], in a `const`.
///
/// # Panics
/// When the system is too large: at compile time.
pub const fn size_of(system: &System<'_>) -> Size {
    match size(system) {
        Some(size) => size,
        None => panic!("at most 65,534 transitions, places, events and links fit into a system"),
    }
}

/// To how many events these outputs go.
const fn routes(system: &System<'_>, component: usize, emits: &[OutputId]) -> usize {
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
