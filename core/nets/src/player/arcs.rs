//! The arcs of a transition as words of a packed marking.

use super::code::Lists;
use super::field::Field;
use super::layout::{complement, lacks_complement, made_complement};
use crate::net::data::{Arc, Ignored, PlaceId, Role, Transition};
use crate::system::data::{Of, System, Target};

/// The tokens that a transition needs, takes, and adds or removes in all.
pub(super) struct Moved<const W: usize> {
    pub(super) need: [u64; W],
    pub(super) take: [u64; W],
    pub(super) delta: [u64; W],
}

/// The arcs of a transition of a component.
pub(super) const fn moved<const W: usize>(
    system: &System<'_>,
    lists: &Lists<'_, W>,
    component: usize,
    at: usize,
) -> Moved<W> {
    let it = &system.components[component].net.transitions[at];
    let (mut need, mut give) = ([0; W], [0; W]);
    let first = lists.places[component] as usize;
    add(&mut need, lists.fields, first, it.take);
    let mut take = need;
    add(&mut need, lists.fields, first, it.read);
    add(&mut give, lists.fields, first, it.give);
    // Complements that the system makes follow their places, by what a transition changes in the
    // end.
    let mut arc = 0;
    while !system.bindings.is_empty() && arc < it.take.len() + it.give.len() {
        let taken = arc < it.take.len();
        let place = if taken { it.take[arc].place } else { it.give[arc - it.take.len()].place };
        let owner = match system.target(Of { component: component as u16, id: place }) {
            Some(Target::Place(owner)) => owner,
            _ => Of { component: component as u16, id: place },
        };
        // The taking arc counts for both of a place that is taken and given.
        let counts = taken || weight(it.take, place) == 0;
        if counts
            && let Some(field) = absence(system, lists, component, owner)
            && !mirrored(system, component, owner, it)
        {
            let word = field.word as usize;
            let (lost, gained) = (weight(it.take, place), weight(it.give, place));
            if lost > gained {
                give[word] += field.tokens(lost - gained);
            } else {
                take[word] += field.tokens(gained - lost);
                // Tokens that the transition reads anyway are part of its needs.
                let read = match complement(system.components[component].net, place) {
                    Some(complement) => weight(it.read, complement),
                    None => 0,
                };
                need[word] += field.tokens((gained - lost).saturating_sub(read));
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

/// The tokens that an event with a guard is ignored with.
pub(super) const fn asked<const W: usize>(
    lists: &Lists<'_, W>,
    component: usize,
    it: &Ignored<'_>,
) -> [u64; W] {
    let first = lists.places[component] as usize;
    let mut need = [0; W];
    need = at_least(need, lists.fields[first + it.place.0 as usize], 1);
    let mut at = 0;
    while at < it.guard.len() {
        let Arc { place, weight } = it.guard[at];
        need = at_least(need, lists.fields[first + place.0 as usize], weight);
        at += 1;
    }
    need
}

/// A need with at least so many tokens of a field: two places of a net may lie in one.
const fn at_least<const W: usize>(mut need: [u64; W], field: Field, tokens: u32) -> [u64; W] {
    let guard = 1 << field.width;
    let tokens = if tokens > guard { guard } else { tokens };
    let all = field.tokens(guard) | (field.mask() << field.shift);
    let word = field.word as usize;
    if need[word] & all < field.tokens(tokens) {
        need[word] = need[word] & !all | field.tokens(tokens);
    }
    need
}

/// The field of a complement that the arcs of this net do not move: the system makes it, or the
/// owner of the place has it and the net that shares the place may not know it.
const fn absence<const W: usize>(
    system: &System<'_>,
    lists: &Lists<'_, W>,
    component: usize,
    owner: Of<PlaceId>,
) -> Option<Field> {
    let first = lists.places[owner.component as usize];
    if lacks_complement(system, owner.component as usize, owner.id.0 as usize) {
        return Some(made_complement(lists.complements, first + owner.id.0 as u16));
    }
    if owner.component as usize == component {
        return None;
    }
    match complement(system.components[owner.component as usize].net, owner.id) {
        Some(complement) => Some(lists.fields[first as usize + complement.0 as usize]),
        None => None,
    }
}

/// Whether a transition of another net, which shares the place, moves the complement itself.
const fn mirrored(
    system: &System<'_>,
    component: usize,
    owner: Of<PlaceId>,
    it: &Transition<'_>,
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

/// Adds arcs to a sum. A weight beyond the field becomes its guard bit: as a need it is never met,
/// as a gift it exceeds the bound.
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
