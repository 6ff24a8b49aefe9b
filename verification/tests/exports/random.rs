//! Random nets to be exported.

use cotama_core::net::owned::{
    OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition,
};
use cotama_core::net::{Arc, EventId, OutputId, PlaceId, Role, Within};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use std::collections::BTreeMap;

pub(crate) const PLACES: u32 = 6;
pub(crate) const SIGNALS: u32 = 3;

fn name() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z]{1,3}", "[ab.\\-_ \"'<>&#\\\\\t\n\r]{0,4}", any::<String>()]
}

/// Names that differ: each ends with its position, a digit.
fn names(count: u32) -> impl Strategy<Value = Vec<String>> {
    let number =
        |names: Vec<String>| names.iter().zip(0..).map(|(name, i)| format!("{name}{i}")).collect();
    vec(name(), count as usize).prop_map(number)
}

fn signals() -> impl Strategy<Value = Vec<OwnedSignal>> {
    let signals = |(names, doc): (Vec<String>, String)| {
        names.into_iter().map(|name| OwnedSignal { name, doc: doc.clone() }).collect()
    };
    (names(SIGNALS), name()).prop_map(signals)
}

/// Arcs to places from `from` on, none twice.
fn arcs(from: u32, to: u32) -> impl Strategy<Value = Vec<Arc>> {
    let arcs = |arcs: BTreeMap<u32, u32>| {
        arcs.into_iter().map(|(p, weight)| Arc { place: PlaceId(p), weight }).collect()
    };
    proptest::collection::btree_map(from..to, 1..4u32, 0..3).prop_map(arcs)
}

fn transition(places: u32, signals: u32) -> impl Strategy<Value = OwnedTransition> {
    let within = (0..100u32, option::of(0..100u32))
        .prop_map(|(earliest, more)| Within { earliest, latest: more.map(|more| earliest + more) });
    let arcs = (arcs(0, places / 2), arcs(places / 2, places), arcs(0, places));
    let rest = (
        vec((0..signals).prop_map(OutputId), 0..3),
        option::of(within),
        any::<i16>(),
        any::<u32>(),
    );
    (name(), name(), option::of((0..signals).prop_map(EventId)), arcs, rest).prop_map(
        |(name, doc, on, (take, read, give), (emits, within, priority, line))| OwnedTransition {
            name,
            doc,
            line,
            on,
            take,
            read,
            give,
            emits,
            within,
            priority,
        },
    )
}

fn law(places: u32) -> impl Strategy<Value = OwnedLaw> {
    let place = || (0..places).prop_map(PlaceId);
    prop_oneof![
        (arcs(0, places), any::<u32>())
            .prop_map(|(sum, equals)| OwnedLaw::Invariant { sum, equals }),
        (place(), place()).prop_map(|(a, b)| OwnedLaw::NeverBoth(a, b)),
        place().prop_map(OwnedLaw::Reachable),
        place().prop_map(OwnedLaw::AlwaysCan),
        Just(OwnedLaw::HandlesAll),
        Just(OwnedLaw::Settles),
        option::of(place()).prop_map(|end| OwnedLaw::DeadlockFree { end }),
        Just(OwnedLaw::Deterministic),
    ]
}

fn places() -> impl Strategy<Value = Vec<OwnedPlace>> {
    let kind = (0..5u8, 0..3u32, 0..4u32, any::<bool>());
    (names(PLACES), vec(kind, PLACES as usize), name()).prop_map(|(names, kinds, doc)| {
        let mut places: Vec<OwnedPlace> = Vec::new();
        for (name, (kind, initial, more, bounded)) in names.into_iter().zip(kinds) {
            let place = OwnedPlace::new(&name, initial).doc(&doc);
            let place = if bounded { place.at_most(initial + more) } else { place };
            places.push(match (kind, places.last()) {
                (0, Some(of)) => {
                    let (initial, bound) = (of.bound - of.initial, of.bound);
                    OwnedPlace {
                        initial,
                        bound,
                        role: Role::Complement(PlaceId(places.len() as u32 - 1)),
                        ..place
                    }
                }
                (1, _) => OwnedPlace { role: Role::Shared, ..place },
                (2, _) => OwnedPlace { role: Role::Mailbox, ..place },
                (3, _) => OwnedPlace { role: Role::Data, ..place },
                _ => place,
            });
        }
        places
    })
}

/// A net whose transitions, laws and ignored events name places below `reach` and signals below
/// `signals`.
pub(crate) fn net_reaching(reach: u32, signal_reach: u32) -> impl Strategy<Value = OwnedNet> {
    let ignored = (0..signal_reach, 0..reach, arcs(0, reach)).prop_map(|(e, p, guard)| {
        let (event, place) = (EventId(e), PlaceId(p));
        OwnedIgnored { event, place, guard }
    });
    let lists =
        (vec(transition(reach, signal_reach), 0..6), vec(ignored, 0..3), vec(law(reach), 0..5));
    ((name(), name()), places(), (signals(), signals()), lists).prop_map(
        |((name, doc), places, (events, outputs), (transitions, ignored, laws))| OwnedNet {
            name,
            doc,
            places,
            events,
            outputs,
            transitions,
            ignored,
            laws,
        },
    )
}

pub(crate) fn net() -> impl Strategy<Value = OwnedNet> {
    net_reaching(PLACES, SIGNALS)
}

/// Two states, the other places variables.
pub(crate) fn machine() -> impl Strategy<Value = OwnedNet> {
    let moves = vec((0..2u32, option::of(0..2u32), transition(PLACES, SIGNALS)), 0..6);
    (net(), moves).prop_map(|(net, moves)| {
        let mut net = OwnedNet { transitions: Vec::new(), ..net };
        for (i, place) in net.places.iter_mut().enumerate() {
            place.role = if i < 2 { Role::State } else { Role::Data };
            place.bound = if i == 3 { 1 } else { u32::MAX };
            place.initial = u32::from(i == 0);
        }
        for (from, to, mut it) in moves {
            for arcs in [&mut it.take, &mut it.read, &mut it.give] {
                arcs.retain(|arc| arc.place.0 >= 2);
            }
            let it = match to {
                Some(to) => it.take(PlaceId(from), 1).give(PlaceId(to), 1),
                None => it.read(PlaceId(from), 1),
            };
            net.transition(it).unwrap();
        }
        net
    })
}

/// Two states, then variables with complements: `v0` up to 1, `v1` up to 5, and `v2` up to 1
/// without one.
pub(crate) fn complemented() -> impl Strategy<Value = OwnedNet> {
    let moves = vec((0..2u32, option::of(0..2u32), vec((0..6u8, 1..3u32), 3)), 1..8);
    (0..2u32, 0..6u32, moves).prop_map(|(v0, v1, moves)| {
        let mut net = OwnedNet::new("complemented", "");
        let state = |name, initial| OwnedPlace::new(name, initial).at_most(1);
        let data = |name, initial, bound| OwnedPlace {
            role: Role::Data,
            ..OwnedPlace::new(name, initial).at_most(bound)
        };
        let rest = |name, of, initial, bound| OwnedPlace {
            role: Role::Complement(of),
            ..data(name, initial, bound)
        };
        let states = [state("a", 1), state("b", 0)].map(|it| net.place(it).unwrap());
        let v = [data("v0", v0, 1), data("v1", v1, 5), data("v2", 0, 1)]
            .map(|it| net.place(it).unwrap());
        let c = [rest("c0", v[0], 1 - v0, 1), rest("c1", v[1], 5 - v1, 5)]
            .map(|it| net.place(it).unwrap());
        for (from, to, uses) in moves {
            let it = OwnedTransition::new(&format!("t{}", net.transitions.len()));
            let mut it = match to {
                Some(to) => it.take(states[from as usize], 1).give(states[to as usize], 1),
                None => it.read(states[from as usize], 1),
            };
            for (i, (usage, weight)) in uses.into_iter().enumerate() {
                it = match (usage, c.get(i)) {
                    (0, Some(&c)) => it.take(c, weight).give(v[i], weight),
                    (1, Some(&c)) => it.take(v[i], weight).give(c, weight),
                    (2, Some(&c)) => it.read(c, weight),
                    (3, _) => it.read(v[i], weight),
                    (4, None) => it.give(v[i], weight),
                    (5, None) => it.take(v[i], weight),
                    _ => it,
                };
            }
            net.transition(it).unwrap();
        }
        net
    })
}
