//! The invariants of every reachable marking, packed: so that a stored marking is judged without
//! the texts of its nets, which a microcontroller then does without.

use super::code::{Code, Kept, Lists, NONE};
use crate::net::data::{Law, Net, PlaceId, Role};
use crate::system::data::System;

impl Kept {
    /// Whether a marking keeps it.
    pub(super) fn holds<const W: usize>(&self, code: &Code<'_, W>, marking: &[u64; W]) -> bool {
        let places = code.summands.get(usize::from(self.first)..usize::from(self.end));
        let tokens = |place: u16| {
            u64::from(code.fields.get(usize::from(place)).map_or(0, |it| it.of(marking)))
        };
        let mut places = places.unwrap_or(&[]).iter();
        match self.equals {
            Some(equals) => {
                let sum = places
                    .map(|&(place, weight)| u64::from(weight).saturating_mul(tokens(place)))
                    .fold(0, u64::saturating_add);
                sum == u64::from(equals)
            }
            None => places.any(|&(place, _)| tokens(place) == 0),
        }
    }
}

/// How many sums and pairs a net has, and how many places they name.
pub(super) const fn count(net: &Net<'_>) -> (usize, usize) {
    let (mut kept, mut summands, mut at) = (0, 0, 0);
    while at < net.laws.len() {
        let places = match net.laws[at] {
            Law::Invariant { sum, .. } => sum.len(),
            Law::NeverBoth(..) => 2,
            _ => 0,
        };
        kept += (places > 0) as usize;
        summands += places;
        at += 1;
    }
    at = 0;
    while at < net.places.len() {
        if let Role::Complement(_) = net.places[at].role {
            kept += 1;
            summands += 2;
        }
        at += 1;
    }
    (kept, summands)
}

/// Sums and pairs of all nets: complements first, then laws in their order.
pub(super) const fn keep<const W: usize>(system: &System<'_>, lists: &mut Lists<'_, W>) {
    let mut done = (0, 0);
    let mut component = 0;
    while component < system.components.len() {
        let net = system.components[component].net;
        let mut at = 0;
        while at < net.places.len() {
            if let Role::Complement(of) = net.places[at].role {
                let pair = [(PlaceId(at as u32), 1), (of, 1)];
                let equals = Some(net.places[at].bound);
                done = add(lists, component, NONE, &pair, equals, done);
            }
            at += 1;
        }
        component += 1;
    }
    component = 0;
    while component < system.components.len() {
        let laws = system.components[component].net.laws;
        let mut at = 0;
        while at < laws.len() {
            match laws[at] {
                Law::Invariant { sum, equals } if !sum.is_empty() => {
                    let (first, before) = (done.1, done.0);
                    let mut arc = 0;
                    while arc < sum.len() {
                        let place = lists.places[component] + sum[arc].place.0 as u16;
                        lists.summands[done.1] = (place, sum[arc].weight);
                        done.1 += 1;
                        arc += 1;
                    }
                    lists.kept[before] = Kept {
                        component: component as u16,
                        law: at as u16,
                        first: first as u16,
                        end: done.1 as u16,
                        equals: Some(equals),
                    };
                    done.0 += 1;
                }
                Law::NeverBoth(a, b) => {
                    done = add(lists, component, at as u16, &[(a, 1), (b, 1)], None, done);
                }
                _ => {}
            }
            at += 1;
        }
        component += 1;
    }
    debug_assert!(done.0 == lists.kept.len(), "each law of markings is listed");
    debug_assert!(done.1 == lists.summands.len(), "each place of them is listed");
}

/// Adds one of two places; how many sums and places there are then.
const fn add<const W: usize>(
    lists: &mut Lists<'_, W>,
    component: usize,
    law: u16,
    places: &[(PlaceId, u32); 2],
    equals: Option<u32>,
    done: (usize, usize),
) -> (usize, usize) {
    let (kept, first) = done;
    let mut at = 0;
    while at < places.len() {
        let (place, weight) = places[at];
        lists.summands[first + at] = (lists.places[component] + place.0 as u16, weight);
        at += 1;
    }
    let end = first + places.len();
    let component = component as u16;
    lists.kept[kept] = Kept { component, law, first: first as u16, end: end as u16, equals };
    (kept + 1, end)
}
