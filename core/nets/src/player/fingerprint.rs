//! Tells systems, and versions of a system, apart.

use crate::net::data::{Arc, Net};
use crate::system::data::{Binding, Clear, Delivery, Link, System, Target};

/// FNV-1a over everything that a stored marking depends on.
pub(super) const fn fingerprint(system: &System<'_>) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325;
    let mut at = 0;
    while at < system.components.len() {
        hash = net(text(hash, system.components[at].name), system.components[at].net);
        at += 1;
    }
    at = 0;
    while at < system.links.len() {
        let Link { from, to, delivery } = system.links[at];
        let room = match delivery {
            Delivery::Now => 0,
            Delivery::Mail { capacity } => capacity as u32,
        };
        hash = port(port(number(hash, room), from.component, from.id.0), to.component, to.id.0);
        at += 1;
    }
    at = 0;
    while at < system.bindings.len() {
        let Binding { shared, target } = system.bindings[at];
        let (kind, component, id) = match target {
            Target::Place(of) => (0, of.component, of.id.0),
            Target::Mailbox(of) => (1, of.component, of.id.0),
        };
        hash = port(number(hash, kind), shared.component, shared.id.0);
        hash = port(hash, component, id);
        at += 1;
    }
    at = 0;
    while at < system.clears.len() {
        let Clear { on, mailbox } = system.clears[at];
        hash = number(port(hash, on.component, on.id.0), mailbox.0);
        at += 1;
    }
    hash
}

const fn port(hash: u64, component: u16, id: u32) -> u64 {
    number(number(hash, component as u32), id)
}

const fn net(hash: u64, net: &Net<'_>) -> u64 {
    let mut hash = text(hash, net.name);
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

const fn arcs(mut hash: u64, arcs: &[Arc]) -> u64 {
    let mut at = 0;
    while at < arcs.len() {
        hash = number(number(hash, arcs[at].place.0), arcs[at].weight);
        at += 1;
    }
    byte(hash, 0xfe)
}
