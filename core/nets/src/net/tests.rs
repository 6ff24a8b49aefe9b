//! Stories of nets whose lists do not fit together.

use super::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use super::{Arc, EventId, NetError, OutputId, PlaceId, Role, Within};
use std::string::ToString;

#[test]
fn two_of_one_name_are_refused_also_in_large_nets() {
    let mut net = OwnedNet::new("large", "");
    for at in 0..100_000 {
        net.place(OwnedPlace::new(&at.to_string(), 0)).unwrap();
    }
    for name in ["go", "stop"] {
        net.event(name, "").unwrap();
        net.output(name, "").unwrap(); // an event and an output may be called alike
        net.transition(OwnedTransition::new("same")).unwrap();
    }
    assert_eq!(net.view().net().defect(), None);
    let with = |change: &dyn Fn(&mut OwnedNet)| {
        let mut other = net.clone();
        change(&mut other);
        other.view().net().defect()
    };
    let twice = |list, at| Some(NetError::Twice { list, at });
    assert_eq!(with(&|it| it.places[70_000].name = "3".to_string()), twice("places", 70_000));
    assert_eq!(with(&|it| it.places[3].name = "70000".to_string()), twice("places", 70_000));
    assert_eq!(with(&|it| it.events[1].name = "go".to_string()), twice("events", 1));
    assert_eq!(with(&|it| it.outputs[0].name = "stop".to_string()), twice("outputs", 1));
    let said = twice("outputs", 1).unwrap().to_string();
    assert_eq!(said, "entry 1 of the outputs has the name of an earlier one; give each its own");
}

const A: PlaceId = PlaceId(0);
const B: PlaceId = PlaceId(1);
const NOWHERE: PlaceId = PlaceId(2);

/// Two places, the second one the complement of the first, one event, one output, one transition.
fn sound() -> OwnedNet {
    let mut net = OwnedNet::new("sound", "");
    net.place(OwnedPlace::new("A", 1).at_most(3)).unwrap();
    let mut other = OwnedPlace::new("B", 2).at_most(3);
    other.role = Role::Complement(A);
    net.place(other).unwrap();
    net.event("go", "").unwrap();
    net.output("gone", "").unwrap();
    let moves = OwnedTransition::new("moves").on(EventId(0)).take(A, 1).give(B, 1).within(5, None);
    net.transition(OwnedTransition { emits: [OutputId(0)].into(), ..moves }).unwrap();
    net
}

/// Returns the defect of the sound net after a change.
fn defect(change: impl FnOnce(&mut OwnedNet)) -> Option<NetError> {
    let mut net = sound();
    assert_eq!(net.view().net().defect(), None);
    change(&mut net);
    net.view().net().defect()
}

#[test]
fn tokens_at_the_start_fit_and_complements_sum_to_the_bound() {
    let place = |place| Some(NetError::Place { place });
    assert_eq!(defect(|it| it.places[0].role = Role::Shared), None);
    // More than the bound, with a role that sums to nothing.
    assert_eq!(
        defect(|it| {
            it.places[1].role = Role::Shared;
            it.places[0].initial = 4;
        }),
        place(0)
    );
    assert_eq!(defect(|it| it.places[0].initial = 2), place(1));
    assert_eq!(defect(|it| it.places[0].bound = 4), place(1));
    assert_eq!(defect(|it| it.places[1].role = Role::Complement(NOWHERE)), place(1));
}

#[test]
fn a_transition_names_existing_places_and_each_once() {
    let unknown = Some(NetError::UnknownId { transition: 0 });
    let arc = Arc { place: NOWHERE, weight: 1 };
    assert_eq!(defect(|it| it.transitions[0].take[0] = arc), unknown);
    assert_eq!(defect(|it| it.transitions[0].read.push(arc)), unknown);
    assert_eq!(defect(|it| it.transitions[0].give[0] = arc), unknown);
    assert_eq!(defect(|it| it.transitions[0].on = Some(EventId(1))), unknown);
    assert_eq!(defect(|it| it.transitions[0].emits.push(OutputId(1))), unknown);
    let arcs = Some(NetError::Arcs { transition: 0 });
    let again = Arc { place: A, weight: 1 };
    assert_eq!(defect(|it| it.transitions[0].read.push(again)), arcs);
    assert_eq!(defect(|it| it.transitions[0].take.push(again)), arcs);
    assert_eq!(defect(|it| it.transitions[0].take.insert(0, Arc { place: B, ..again })), None);
    assert_eq!(defect(|it| it.transitions[0].take[0].weight = 0), arcs);
    assert_eq!(defect(|it| it.transitions[0].give[0].weight = 0), arcs);
    let long = Within { earliest: 0, latest: Some(u32::MAX) };
    assert_eq!(
        defect(|it| it.transitions[0].within = Some(long)),
        Some(NetError::Interval { transition: 0 })
    );
}

#[test]
fn laws_and_ignored_pairs_name_existing_parts() {
    let law = |law: OwnedLaw| defect(|it| it.laws.push(law));
    let bad = Some(NetError::Law);
    let sum = |places: &[PlaceId]| OwnedLaw::Invariant {
        sum: places.iter().map(|&place| Arc { place, weight: 1 }).collect(),
        equals: 3,
    };
    assert_eq!([law(sum(&[A, B])), law(sum(&[A, NOWHERE])), law(sum(&[A, A]))], [None, bad, bad]);
    assert_eq!(law(OwnedLaw::NeverBoth(A, B)), None);
    assert_eq!(law(OwnedLaw::NeverBoth(A, NOWHERE)), bad);
    assert_eq!(law(OwnedLaw::NeverBoth(NOWHERE, A)), bad);
    for place in [A, NOWHERE] {
        let expected = if place == A { None } else { bad };
        assert_eq!(law(OwnedLaw::Reachable(place)), expected);
        assert_eq!(law(OwnedLaw::AlwaysCan(place)), expected);
        assert_eq!(law(OwnedLaw::DeadlockFree { end: Some(place) }), expected);
    }
    let ignores = |it: OwnedIgnored| defect(|net| net.ignored.push(it));
    let go = EventId(0);
    assert_eq!(ignores(OwnedIgnored::new(go, A).guard(B, 1)), None);
    assert_eq!(ignores(OwnedIgnored::new(EventId(1), A)), bad);
    assert_eq!(ignores(OwnedIgnored::new(go, NOWHERE)), bad);
    assert_eq!(ignores(OwnedIgnored::new(go, A).guard(NOWHERE, 1)), bad);
    assert_eq!(ignores(OwnedIgnored::new(go, A).guard(B, 1).guard(B, 1)), bad);
}

#[test]
fn the_documentation_of_a_place_and_of_a_transition_stays_with_it() {
    let place = OwnedPlace::new("A", 1).doc("Waits.").at_most(2);
    assert_eq!((place.doc.as_str(), place.name.as_str(), place.bound), ("Waits.", "A", 2));
    let it = OwnedTransition::new("t").doc("Goes.").on(EventId(3)).within(1, None);
    assert_eq!((it.doc.as_str(), it.name.as_str(), it.on), ("Goes.", "t", Some(EventId(3))));
}
