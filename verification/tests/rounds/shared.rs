//! Places that random nets share: flags and counters of one that others read and change, and
//! mailboxes that they look at.

use crate::conformance::Draw;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{OutputId, PlaceId, Role};
use cotama_core::system::{Binding, Delivery, Link, Of, Target};

/// A place and, where there is one, its complement.
#[derive(Clone, Copy)]
struct Pair {
    place: PlaceId,
    complement: Option<PlaceId>,
    /// Whether the net moves the complement itself when it changes the place.
    moves: bool,
    /// A mailbox can only be read.
    reads: bool,
}

impl Pair {
    fn new(draw: &mut Draw, net: &mut OwnedNet, name: &str, place: PlaceId, owns: bool) -> Self {
        let mut pair = Self { place, complement: None, moves: owns, reads: false };
        if draw.below(2) == 0 {
            let of = &net.places[place.0 as usize];
            let it = OwnedPlace::new(&format!("no_{name}"), of.bound - of.initial);
            let it = OwnedPlace { role: Role::Complement(place), ..it.at_most(of.bound) };
            pair.complement = Some(net.place(it).unwrap());
            pair.moves |= draw.below(2) == 0;
        }
        pair
    }

    /// One more or one less.
    fn change(self, it: OwnedTransition, more: bool) -> OwnedTransition {
        let other = self.complement.filter(|_| self.moves);
        let (from, to) = if more { (other, Some(self.place)) } else { (Some(self.place), other) };
        let it = from.map_or(it.clone(), |from| it.take(from, 1));
        to.map_or(it.clone(), |to| it.give(to, 1))
    }

    /// A guard or an effect.
    fn uses(self, draw: &mut Draw, it: OwnedTransition) -> OwnedTransition {
        match draw.below(4) {
            0 if !self.reads => self.change(it, true),
            1 if !self.reads => self.change(it, false),
            2 => it.read(self.complement.unwrap_or(self.place), 1),
            _ => it.read(self.place, 1),
        }
    }
}

/// Adds flags, places of others, and transitions without event that look at them.
pub(super) fn share(draw: &mut Draw, nets: &mut [OwnedNet; 3], links: &[Link]) -> Vec<Binding> {
    let counter = PlaceId(3);
    let mut own = Vec::new();
    for net in nets.iter_mut() {
        let flag = net.place(OwnedPlace::new("f", draw.below(2)).at_most(1)).unwrap();
        let flag = Pair::new(draw, net, "f", flag, true);
        let count = Pair::new(draw, net, "n", counter, true);
        if let Some(complement) = count.complement {
            for it in &mut net.transitions {
                let has =
                    |arcs: &[cotama_core::net::Arc]| arcs.iter().any(|it| it.place == counter);
                *it = match (has(&it.take), has(&it.give)) {
                    (true, _) => std::mem::take(it).give(complement, 1),
                    (_, true) => std::mem::take(it).take(complement, 1),
                    _ => continue,
                };
            }
        }
        own.push(flag);
    }
    let mut bindings = Vec::new();
    for component in 0..3_u16 {
        let owner = (component + 1 + draw.below(2) as u16) % 3;
        let mail: Vec<_> = links.iter().filter(|it| it.delivery != Delivery::Now).collect();
        let (target, bound) = match draw.below(5) {
            0 if !mail.is_empty() => {
                let link = mail[draw.below(mail.len() as u32) as usize];
                let Delivery::Mail { capacity } = link.delivery else { unreachable!() };
                (Target::Mailbox(link.to), u32::from(capacity))
            }
            1 | 2 => (Target::Place(Of { component: owner, id: counter }), 2),
            _ => {
                let id = own[usize::from(owner)].place;
                (Target::Place(Of { component: owner, id }), 1)
            }
        };
        let net = &mut nets[usize::from(component)];
        let guest = OwnedPlace { role: Role::Shared, ..OwnedPlace::new("g", 0).at_most(bound) };
        let guest = net.place(guest).unwrap();
        bindings.push(Binding { shared: Of { component, id: guest }, target });
        let guest = Pair {
            reads: matches!(target, Target::Mailbox(_)),
            ..Pair::new(draw, net, "g", guest, false)
        };
        let flag = own[usize::from(component)];
        for it in &mut net.transitions {
            *it = match draw.below(4) {
                0 => guest.uses(draw, std::mem::take(it)),
                1 => flag.uses(draw, std::mem::take(it)),
                _ => continue,
            };
        }
        for number in 0..=draw.below(2) {
            let from = draw.below(3);
            let to = from + draw.below(3 - from);
            let mut it = OwnedTransition::new(&format!("u{number}"));
            it = it.take(PlaceId(from), 1).give(PlaceId(to), 1);
            // A transition that stays in its place uses something up, so that most nets settle.
            it = match draw.below(3) {
                0 if from < to => guest.uses(draw, it),
                1 if !guest.reads => guest.uses(draw, flag.change(it, false)),
                _ => flag.change(guest.uses(draw, it), from == to && draw.below(2) == 0),
            };
            it.priority = draw.below(3) as i16;
            it.emits = (0..draw.below(2)).map(|_| OutputId(draw.below(4))).collect();
            net.transition(it).unwrap();
        }
    }
    bindings
}
