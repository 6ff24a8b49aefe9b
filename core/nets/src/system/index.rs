//! Finds the links and bindings of a system: sorted lists, also while compiling.

use super::data::{Delivery, Link, Of, System};
use crate::net::data::{EventId, PlaceId, TransitionId};

/// Numbers of a component and of something of its net as one, and a position in a list.
pub(super) type Entry = (u64, u32);

pub(super) const fn key(component: u16, id: u32) -> u64 {
    (component as u64) << 32 | id as u64
}

/// Finds the links to an event, those from an output, and the bindings of a place. Its memory is
/// as long as the lists of the system.
pub(super) struct Index<'i> {
    /// Entries by event: as many as links.
    pub(super) links: &'i mut [Entry],
    /// Entries by output: as many as links.
    pub(super) says: &'i mut [Entry],
    /// Entries by shared place: as many as bindings.
    pub(super) bindings: &'i mut [Entry],
    /// As many as components: how many rendezvous can follow from one another.
    pub(super) chains: &'i mut [u8],
}

impl Index<'_> {
    pub(super) const fn fill(&mut self, system: &System<'_>) {
        let mut at = 0;
        while at < system.links.len() {
            let Link { from, to, .. } = system.links[at];
            self.links[at] = (key(to.component, to.id.0), at as u32);
            self.says[at] = (key(from.component, from.id.0), at as u32);
            at += 1;
        }
        let mut at = 0;
        while at < system.bindings.len() {
            let shared = system.bindings[at].shared;
            self.bindings[at] = (key(shared.component, shared.id.0), at as u32);
            at += 1;
        }
        sort(self.links);
        sort(self.says);
        sort(self.bindings);
    }

    pub(super) const fn delivery(&self, system: &System<'_>, to: Of<EventId>) -> Option<Delivery> {
        match first(self.links, key(to.component, to.id.0)) {
            Some(at) => Some(system.links[at].delivery),
            None => None,
        }
    }

    pub(super) const fn mailbox(&self, system: &System<'_>, of: Of<EventId>) -> Option<u16> {
        match self.delivery(system, of) {
            Some(Delivery::Mail { capacity }) => Some(capacity),
            _ => None,
        }
    }

    /// How much a transition mails to this event at once.
    pub(super) const fn mailed(
        &self,
        system: &System<'_>,
        from: Of<TransitionId>,
        to: Of<EventId>,
    ) -> usize {
        let emits =
            system.components[from.component as usize].net.transitions[from.id.0 as usize].emits;
        let (mut count, mut emit) = (0, 0);
        while emit < emits.len() {
            let key = key(from.component, emits[emit].0);
            let mut at = position(self.says, key);
            while at < self.says.len() && self.says[at].0 == key {
                let it = system.links[self.says[at].1 as usize].to;
                count += (it.component == to.component && it.id.0 == to.id.0) as usize;
                at += 1;
            }
            emit += 1;
        }
        count
    }

    pub(super) const fn binding(&self, shared: Of<PlaceId>) -> Option<usize> {
        first(self.bindings, key(shared.component, shared.id.0))
    }
}

/// Sorts by heap: n log n steps, no memory.
const fn sort(list: &mut [Entry]) {
    let (mut root, mut end) = (list.len() / 2, list.len());
    while end > 1 {
        if root > 0 {
            root -= 1;
        } else {
            end -= 1;
            list.swap(0, end);
        }
        let mut at = root;
        while 2 * at + 1 < end {
            let mut child = 2 * at + 1;
            if child + 1 < end && less(list[child], list[child + 1]) {
                child += 1;
            }
            if !less(list[at], list[child]) {
                break;
            }
            list.swap(at, child);
            at = child;
        }
    }
}

const fn less(a: Entry, b: Entry) -> bool {
    a.0 < b.0 || a.0 == b.0 && a.1 < b.1
}

/// Returns the position of this key, or the one at which it would be inserted.
pub(super) const fn position(sorted: &[Entry], key: u64) -> usize {
    let (mut from, mut to) = (0, sorted.len());
    while from < to {
        let middle = usize::midpoint(from, to);
        if sorted[middle].0 < key {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    from
}

/// The first position of this key in the list that was sorted.
const fn first(sorted: &[Entry], key: u64) -> Option<usize> {
    let at = position(sorted, key);
    if at < sorted.len() && sorted[at].0 == key { Some(sorted[at].1 as usize) } else { None }
}
