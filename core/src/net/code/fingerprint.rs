//! Tells nets, and versions of a net, apart.

use crate::net::data::{Arc, Net};

/// FNV-1a over everything that a stored marking depends on.
pub(super) const fn fingerprint(net: &Net<'_>) -> u64 {
    let mut hash = text(0xcbf2_9ce4_8422_2325, net.name);
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
