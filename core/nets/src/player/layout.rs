//! The layout of a system's places and mailboxes in a marking.

use super::code::{Lists, Mailbox, NONE, Words};
use super::field::{Field, clamped};
use crate::net::data::{EventId, Net, Place, PlaceId, Role};
use crate::system::data::{Binding, Delivery, Of, System, Target};

/// The bits laid out so far.
pub(super) struct Used {
    word: u16,
    bits: u8,
}

impl Used {
    pub(super) const NOTHING: Self = Self { word: 0, bits: 0 };

    /// Returns the number of words.
    pub(super) const fn words(&self) -> usize {
        self.word as usize + 1
    }

    /// A field is appended; where it lies.
    pub(super) const fn place(&mut self, bound: u32) -> Field {
        let width = (u32::BITS - clamped(bound).leading_zeros()) as u8;
        if self.bits + width + 1 > 64 {
            self.word += 1;
            self.bits = 0;
        }
        let field = Field { word: self.word, shift: self.bits, width };
        self.bits += width + 1;
        field
    }
}

/// Whether a place has a field of its own. A shared place and its complement lie where those of the
/// owner do. A net alone owns all of its places.
pub(super) const fn owns(system: &System<'_>, component: usize, at: usize) -> bool {
    let places = system.components[component].net.places;
    let shared = match places[at].role {
        Role::Shared => at,
        Role::Complement(of) if matches!(places[of.0 as usize].role, Role::Shared) => of.0 as usize,
        _ => return true,
    };
    let of = Of { component: component as u16, id: PlaceId(shared as u32) };
    system.target(of).is_none()
}

/// The complement of a place in its net.
pub(super) const fn complement(net: &Net<'_>, of: PlaceId) -> Option<PlaceId> {
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
pub(super) const fn lacks_complement(system: &System<'_>, component: usize, at: usize) -> bool {
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

/// Lays out all fields.
pub(super) const fn layout<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    words: &mut Words<W>,
) {
    let mut used = Used::NOTHING;
    let (mut made, mut component) = (0, 0);
    while component < system.components.len() {
        let places = system.components[component].net.places;
        let first = lists.places[component] as usize;
        let mut at = 0;
        while at < places.len() {
            let Place { initial, bound, .. } = places[at];
            if owns(system, component, at) {
                let field = used.place(bound);
                lists.fields[first + at] = field;
                fill(words, field, initial, bound);
                if lacks_complement(system, component, at) {
                    let field = used.place(bound);
                    lists.complements[made] = ((first + at) as u16, field);
                    made += 1;
                    fill(words, field, clamped(bound) - initial, bound);
                }
            }
            at += 1;
        }
        component += 1;
    }
    debug_assert!(made == lists.complements.len(), "each place that lacks one gets one");
    mailboxes(system, lists, words, &mut used);
    shared(system, lists);
}

/// Whether a shared place that is the mailbox of this event has a complement.
pub(super) const fn asks_for_room(system: &System<'_>, event: Of<EventId>) -> bool {
    let mut at = 0;
    while at < system.bindings.len() {
        let Binding { shared, target } = system.bindings[at];
        let net = system.components[shared.component as usize].net;
        if let Target::Mailbox(of) = target
            && of.component == event.component
            && of.id.0 == event.id.0
            && complement(net, shared.id).is_some()
        {
            return true;
        }
        at += 1;
    }
    false
}

/// A field for what waits in each mailbox, and one for the room where a transition asks for it.
const fn mailboxes<const W: usize>(
    system: &System<'_>,
    lists: &mut Lists<'_, W>,
    words: &mut Words<W>,
    used: &mut Used,
) {
    let (mut count, mut slot, mut component) = (0, 0, 0);
    while component < system.components.len() {
        lists.turns[component] = count as u16;
        let mut at = 0;
        while at < system.components[component].net.events.len() {
            let of = Of { component: component as u16, id: EventId(at as u32) };
            if let Some(Delivery::Mail { capacity }) = system.delivery(of) {
                let most = capacity as u32;
                let waiting = used.place(most);
                fill(words, waiting, 0, most);
                let mut room = None;
                if asks_for_room(system, of) {
                    let field = used.place(most);
                    fill(words, field, most, most);
                    room = Some(field);
                }
                let event = lists.events[component] + at as u16;
                lists.mailboxes[count] = Mailbox { event, waiting, room, slot, capacity };
                count += 1;
                slot += capacity;
            }
            at += 1;
        }
        component += 1;
    }
    debug_assert!(count == lists.mailboxes.len(), "each mailbox is listed");
    lists.turns[component] = count as u16;
}

const fn fill<const W: usize>(words: &mut Words<W>, field: Field, initial: u32, bound: u32) {
    let word = field.word as usize;
    debug_assert!(words.guards[word] >> field.shift == 0, "no field lies over another");
    words.guards[word] |= 1 << (field.shift + field.width);
    words.bounds[word] |= field.tokens(clamped(bound));
    words.initial[word] |= field.tokens(initial);
}

/// Shared places, and their complements, lie where the places lie that they are bound to.
const fn shared<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) {
    let mut at = 0;
    while at < system.bindings.len() {
        let binding = system.bindings[at];
        let own = lists.places[binding.shared.component as usize] as usize;
        let (place, absence) = match binding.target {
            Target::Place(owner) => {
                let first = lists.places[owner.component as usize] as usize;
                let of = first + owner.id.0 as usize;
                let net = system.components[owner.component as usize].net;
                let absence = match complement(net, owner.id) {
                    Some(complement) => lists.fields[first + complement.0 as usize],
                    None => made_complement(lists.complements, of as u16),
                };
                (lists.fields[of], absence)
            }
            Target::Mailbox(event) => {
                let event = lists.events[event.component as usize] + event.id.0 as u16;
                let mailbox = lists.mailboxes[mailbox_of(lists.mailboxes, event) as usize];
                let room = match mailbox.room {
                    Some(room) => room,
                    None => mailbox.waiting, // nobody asks
                };
                (mailbox.waiting, room)
            }
        };
        lists.fields[own + binding.shared.id.0 as usize] = place;
        let net = system.components[binding.shared.component as usize].net;
        if let Some(complement) = complement(net, binding.shared.id) {
            lists.fields[own + complement.0 as usize] = absence;
        }
        at += 1;
    }
}

/// Returns the field of the complement that the system makes for this place.
pub(super) const fn made_complement(complements: &[(u16, Field)], place: u16) -> Field {
    let mut at = 0;
    while complements[at].0 != place {
        at += 1;
    }
    complements[at].1
}

/// The position of the mailbox of an event.
pub(super) const fn mailbox_of(mailboxes: &[Mailbox], event: u16) -> u16 {
    let mut at = 0;
    while at < mailboxes.len() {
        if mailboxes[at].event == event {
            return at as u16;
        }
        at += 1;
    }
    NONE
}
