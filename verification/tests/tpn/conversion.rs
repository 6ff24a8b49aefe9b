//! Time nets from nets with events, and back.

use crate::tpn::{bound, net};
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_verification::tpn::{Difference, Interval, NotANet, TimeNetDefect, from_net, to_net};

/// A lamp that an event turns on and time turns off.
fn lamp() -> OwnedNet {
    let mut lamp = OwnedNet::new("lamp", "");
    let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
    let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
    let press = lamp.event("press", "").unwrap();
    lamp.transition(OwnedTransition::new("turn_on").on(press).take(off, 1).give(on, 1)).unwrap();
    lamp.transition(
        OwnedTransition::new("fade").take(on, 1).give(off, 1).within(2_000, Some(5_000)),
    )
    .unwrap();
    lamp.transition(
        OwnedTransition::new("again").on(press).take(on, 1).give(on, 1).within(100, Some(900)),
    )
    .unwrap();
    lamp
}

#[test]
fn intervals_are_milliseconds_and_events_come_at_any_time() {
    let converted = from_net(&lamp().view().net()).unwrap();
    let intervals: Vec<_> = converted.net.transitions().iter().map(|it| it.interval).collect();
    assert_eq!(intervals, [Interval::ANY, Interval::closed(2_000, 5_000), Interval::at_least(100)]);
    assert_eq!(
        converted.differences,
        [
            Difference::Order,
            Difference::Events(vec![TransitionId(0), TransitionId(2)]),
            Difference::Latest(vec![TransitionId(2)]),
        ]
    );
    assert_eq!(converted.differences[1].to_string(), "2 transitions fire without their event");
}

#[test]
fn a_transition_without_event_fires_at_once() {
    let mut door = OwnedNet::new("door", "");
    let shut = door.place(OwnedPlace::new("shut", 1)).unwrap();
    let key = door.place(OwnedPlace::new("key", 2)).unwrap();
    let open = door.place(OwnedPlace::new("open", 0)).unwrap();
    door.transition(OwnedTransition::new("open").take(shut, 1).read(key, 2).give(open, 1)).unwrap();
    let converted = from_net(&door.view().net()).unwrap();
    assert_eq!(converted.net.transitions()[0].interval, Interval::NOW);
    assert_eq!(converted.net.transitions()[0].read, [Arc { place: PlaceId(1), weight: 2 }]);
    assert_eq!(converted.differences, []); // one transition alone has no order
}

#[test]
fn a_net_goes_there_and_back() {
    let time = net(
        "net n  tr a : {what it does} [3,8] p?2 q*3 -> r  tr b [7,w[ r ->  pl p : place (2)  pl q \
         (9)",
    );
    let back = to_net(&time).unwrap();
    assert_eq!(back.view().net().defect(), None);
    let there = from_net(&back.view().net()).unwrap();
    assert_eq!(there.differences, [Difference::Order]);
    for (a, b) in time.transitions().iter().zip(there.net.transitions()) {
        let parts = |it: &cotama_verification::tpn::TimeTransition| {
            (it.take.clone(), it.read.clone(), it.give.clone())
        };
        assert_eq!((&a.name, a.interval, parts(a)), (&b.name, b.interval, parts(b)));
    }
    assert_eq!(bound(&time, "a", "q"), bound(&there.net, "a", "q"));
}

#[test]
fn intervals_that_a_net_cannot_have_are_refused() {
    let refused = |text: &str| to_net(&net(text)).map(|_| ()).unwrap_err();
    let [first, second] = [TransitionId(0), TransitionId(1)];
    assert_eq!(refused("tr a ]3,8] ->"), NotANet::Open(first));
    assert_eq!(refused("tr a -> tr b [3,8[ ->"), NotANet::Open(second));
    assert_eq!(refused("tr a [0,4294967296] ->"), NotANet::Large(first));
    assert_eq!(refused("tr a [4294967296,w[ ->"), NotANet::Large(first));
    assert_eq!(refused("tr a p p?2 ->"), NotANet::TakenAndRead(first));
    assert_eq!(NotANet::Open(first).to_string(), "the interval of transition 0 has an open bound");
}

#[test]
fn a_net_that_does_not_fit_together_is_refused() {
    let mut twice = lamp();
    twice.places[1].name = "off".to_owned();
    assert_eq!(from_net(&twice.view().net()), Err(TimeNetDefect::PlaceTwice("off".to_owned())));
    let mut lost = lamp();
    lost.transitions[1].give[0].place = PlaceId(9);
    assert_eq!(from_net(&lost.view().net()), Err(TimeNetDefect::UnknownPlace(TransitionId(1))));
    let mut empty = lamp();
    empty.transitions[1] = empty.transitions[1].clone().within(6_000, Some(5_000));
    assert_eq!(from_net(&empty.view().net()), Err(TimeNetDefect::Empty(TransitionId(1))));
}
