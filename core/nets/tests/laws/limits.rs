//! How large a net may be whose laws are looked at while compiling.

use crate::programs::{B, GO, fires, step, verdict};
use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Culprit, Known, Limit, PlaceId, Step, judge};
use cotama_core::player::Packed;

/// A transition on an event is one move, a place that others might change is two.
#[test]
fn more_than_16_384_moves_are_too_many() {
    let loops = |count: u32| {
        let mut net = OwnedNet::new("loops", "");
        net.event("go", "").unwrap();
        for (name, tokens) in [("A", 1), ("B", 0), ("C", 0)] {
            net.place(OwnedPlace::new(name, tokens).at_most(1)).unwrap();
        }
        for at in 0..count {
            net.transition(step(&format!("t{at}"), B, B).on(GO)).unwrap();
        }
        net
    };
    assert!(verdict(&loops(16_378)).is_ok());
    assert_eq!(verdict(&loops(16_379)), Err((Culprit::TooLarge(Limit::Parts), vec![])));
}

/// The message names the time where clocks tell markings apart.
#[test]
fn more_than_1_024_markings_are_too_many() {
    let counts = |most: u32, timer: bool| {
        let mut net = OwnedNet::new("counts", "");
        net.event("go", "").unwrap();
        let room = net.place(OwnedPlace::new("Room", most).at_most(most)).unwrap();
        let parts = net.place(OwnedPlace::new("Parts", 0).at_most(most)).unwrap();
        net.transition(step("adds", room, parts).on(GO)).unwrap();
        if timer {
            let over = OwnedTransition::new("over").take(parts, most).give(room, most);
            net.transition(over.within(5, Some(5))).unwrap();
        }
        let view = net.view();
        let packed = Packed::<1, 9>::alone(&view.net()).unwrap();
        judge(&view.net(), &packed.code()).map_err(|it| {
            assert_eq!(it.culprit, Culprit::TooLarge(Limit::Classes));
            let mut text = String::new();
            it.write(&view.net(), &packed.code(), &mut text).unwrap();
            text
        })
    };
    let known = Known::Explored { markings: 1_024, firings: 1_023, settle: 0 };
    assert_eq!(counts(1_023, false), Ok(known));
    let too_many = |told: &str| {
        Err(format!(
            "net `counts` has more than 1,024 markings{told}, too many to explore while compiling: \
             say `left_to_checker;` in its laws, and check it with the model checker"
        ))
    };
    assert_eq!(counts(1_024, false), too_many(""));
    assert_eq!(counts(1_024, true), too_many(", told apart by their clocks"));
}

#[test]
fn more_than_eight_clocks_are_too_many() {
    let timers = |count: u32| {
        let mut net = OwnedNet::new("timers", "");
        for at in 0..count {
            let place = net.place(OwnedPlace::new(&format!("P{at}"), 1).at_most(1)).unwrap();
            let timer = OwnedTransition::new(&format!("t{at}")).take(place, 1);
            net.transition(timer.within(at, Some(at))).unwrap();
        }
        net
    };
    assert!(verdict(&timers(8)).is_ok());
    assert_eq!(verdict(&timers(9)), Err((Culprit::TooLarge(Limit::Clocks), vec![])));
}

/// When all that wait for an event may fire, time changes nothing any more.
#[test]
fn eight_clocks_may_wait_for_good() {
    let mut net = OwnedNet::new("waiting", "");
    net.event("go", "").unwrap();
    for at in 0..8 {
        let place = net.place(OwnedPlace::new(&format!("P{at}"), 1).at_most(1)).unwrap();
        let waits = OwnedTransition::new(&format!("t{at}")).take(place, 1).on(GO);
        net.transition(waits.within(1, None)).unwrap();
    }
    assert_eq!(verdict(&net), Ok(Known::Explored { markings: 9, firings: 8, settle: 0 }));
}

/// When one of eight ends, a ninth can run.
#[test]
fn a_ninth_timer_begins_when_one_of_eight_has_ended() {
    let mut net = OwnedNet::new("timers", "");
    for at in 0..9 {
        net.place(OwnedPlace::new(&format!("P{at}"), u32::from(at < 8)).at_most(1)).unwrap();
    }
    for at in 0..9 {
        let mut timer = OwnedTransition::new(&format!("t{at}")).take(PlaceId(at), 1);
        if at == 0 {
            timer = timer.give(PlaceId(8), 1);
        }
        let after = if at == 0 { 2 } else { 100 };
        net.transition(timer.within(after, Some(after))).unwrap();
    }
    net.laws.push(OwnedLaw::NeverBoth(PlaceId(8), PlaceId(7)));
    assert_eq!(verdict(&net), Err((Culprit::Both, vec![Step::Passes(2), fires(0)])));
    net.laws = vec![OwnedLaw::NeverBoth(PlaceId(8), PlaceId(0))];
    assert!(verdict(&net).is_ok());
}
