//! Programs whose laws were once judged by a token game that no player plays.

use cotama_core::net::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{
    Arc, Culprit, EventId, Graph, Known, PlaceId, Role, Step, TransitionId, Way, judge,
};
use cotama_core::player::{Outcome, Packed, Player, Why};
use cotama_core::system::{Component, Of, System};
use cotama_core::units::Millis;

const A: PlaceId = PlaceId(0);
pub(crate) const B: PlaceId = PlaceId(1);
const C: PlaceId = PlaceId(2);
pub(crate) const GO: EventId = EventId(0);
const BACK: EventId = EventId(1);

/// Places `A` (marked), `B`, `C`, events `go` and `back`.
fn net(transitions: Vec<OwnedTransition>, law: OwnedLaw) -> OwnedNet {
    let mut net = OwnedNet::new("program", "");
    for (name, tokens) in [("A", 1), ("B", 0), ("C", 0)] {
        net.place(OwnedPlace::new(name, tokens).at_most(1)).unwrap();
    }
    for name in ["go", "back"] {
        net.event(name, "").unwrap();
    }
    for transition in transitions {
        net.transition(transition).unwrap();
    }
    net.laws.push(law);
    net
}

pub(crate) fn step(name: &str, from: PlaceId, to: PlaceId) -> OwnedTransition {
    OwnedTransition::new(name).take(from, 1).give(to, 1)
}

/// Returns the violation, and the path there.
pub(crate) fn verdict(net: &OwnedNet) -> Result<Known, (Culprit, Vec<Step>)> {
    let view = net.view();
    let packed = Packed::<1, 9>::alone(&view.net()).unwrap();
    let violation = judge(&view.net(), &packed.code());
    violation.map_err(|it| (it.culprit, Way::steps(&it.way).to_vec()))
}

pub(crate) fn fires(at: u32) -> Step {
    Step::Fires(TransitionId(at))
}

/// `A => B within 0..=100 ms` on `go`.
fn window(law: OwnedLaw) -> OwnedNet {
    net(vec![step("ab", A, B).on(GO).within(0, Some(100)), step("ba", B, A).on(BACK)], law)
}

#[test]
fn a_window_that_closes_is_a_dead_end() {
    let net = window(OwnedLaw::DeadlockFree { end: None });
    let view = net.view();
    let packed = Packed::<1, 1>::alone(&view.net()).unwrap();
    let (plain, go) = (view.net(), Of { component: 0, id: GO });
    let alone = [Component::alone(&plain)];
    let program = packed.load(&System::alone(&alone));
    let mut player = Player::<_, 1, 1>::start(program, Millis(0), &mut ());
    let late = Why::TooLate(Of { component: 0, id: TransitionId(0) });
    assert_eq!(player.offer(Millis(101), &go), Outcome::Ignored { why: late });

    let stuck = Culprit::Stuck { closed: Some(TransitionId(0)) };
    assert_eq!(verdict(&net), Err((stuck, vec![Step::Passes(101)])));
    let can = window(OwnedLaw::AlwaysCan(B));
    assert_eq!(verdict(&can), Err((Culprit::Never { markings: 2 }, vec![Step::Passes(101)])));
    let mut handles = window(OwnedLaw::HandlesAll);
    handles.ignored = vec![ignored(BACK, A), ignored(GO, B)];
    let unanswered = Culprit::Unanswered { event: GO, closed: Some(TransitionId(0)) };
    assert_eq!(verdict(&handles), Err((unanswered, vec![Step::Passes(101)])));
    handles.ignored.push(ignored(GO, A));
    assert_eq!(verdict(&handles), Ok(Known::Explored { markings: 2, firings: 2, settle: 0 }));
}

fn ignored(event: EventId, place: PlaceId) -> OwnedIgnored {
    OwnedIgnored::new(event, place)
}

#[test]
fn nothing_happens_where_the_net_does_not_rest() {
    let hidden = |law| {
        let leaves = step("leaves", B, A);
        net(vec![step("ab", A, B).on(GO), leaves, step("bc", B, C).on(BACK)], law)
    };
    for law in [OwnedLaw::Reachable(C), OwnedLaw::AlwaysCan(C)] {
        let (culprit, way) = verdict(&hidden(law)).unwrap_err();
        assert_eq!((culprit, way), (Culprit::Never { markings: 2 }, vec![]));
    }
    // In passing it is marked.
    for law in [OwnedLaw::Reachable(B), OwnedLaw::AlwaysCan(B)] {
        assert_eq!(
            verdict(&hidden(law)),
            Ok(Known::Explored { markings: 2, firings: 2, settle: 1 })
        );
    }
    let both = |law| {
        let splits = OwnedTransition::new("splits").on(GO).take(A, 1).give(B, 1).give(C, 1);
        let joins = OwnedTransition::new("joins").take(B, 1).take(C, 1).give(A, 1);
        net(vec![splits, joins], law)
    };
    let refuted = Err((Culprit::Both, vec![fires(0)]));
    assert_eq!(verdict(&both(OwnedLaw::NeverBoth(B, C))), refuted);
}

#[test]
fn the_highest_priority_fires_and_no_other() {
    let prefers = |priority| {
        let high = OwnedTransition { priority, ..step("ac", A, C).on(GO) };
        net(vec![step("ab", A, B).on(GO), high], OwnedLaw::Reachable(B))
    };
    assert_eq!(verdict(&prefers(1)), Err((Culprit::Never { markings: 2 }, vec![])));
    assert_eq!(verdict(&prefers(0)), Ok(Known::Explored { markings: 2, firings: 1, settle: 0 }));
}

#[test]
fn two_timers_of_one_instant_are_told_apart_by_their_lines() {
    let timers = |ms, law| {
        let slow = step("ac", A, C).within(ms, Some(ms));
        net(vec![step("ab", A, B).within(5, Some(5)), slow], law)
    };
    let together = Culprit::Together { first: TransitionId(0), second: TransitionId(1) };
    let refuted = Err((together, vec![Step::Passes(5)]));
    assert_eq!(verdict(&timers(5, OwnedLaw::Deterministic)), refuted);
    assert!(verdict(&timers(6, OwnedLaw::Deterministic)).is_ok());
    assert!(verdict(&timers(6, OwnedLaw::Reachable(B))).is_ok());
    assert!(verdict(&timers(4, OwnedLaw::Reachable(B))).is_err());
}

#[test]
fn a_loop_in_no_time_is_found() {
    let blinks = |ms| {
        let back = step("ba", B, A).within(ms, Some(ms));
        net(vec![step("ab", A, B).within(0, Some(0)), back], OwnedLaw::Settles)
    };
    let forever = Culprit::Forever { repeats: 2 };
    assert_eq!(verdict(&blinks(0)), Err((forever, vec![fires(0), fires(1)])));
    assert!(verdict(&blinks(1)).is_ok());
}

/// Two timers of some seconds that are started by events: all their differences are possible.
#[test]
fn timers_of_seconds_need_few_classes() {
    let mut net = OwnedNet::new("timers", "");
    for name in ["A", "B", "C", "a", "b", "c"] {
        let tokens = u32::from(matches!(name, "A" | "a"));
        net.place(OwnedPlace::new(name, tokens).at_most(1)).unwrap();
    }
    for name in ["go", "back", "Go", "Back"] {
        net.event(name, "").unwrap();
    }
    for (at, long) in [(0, 5_000), (3, 3_000)] {
        let (idle, runs, over) = (PlaceId(at), PlaceId(at + 1), PlaceId(at + 2));
        let on = |it: u32| EventId(2 * at / 3 + it);
        for transition in [
            step("start", idle, runs).on(on(0)),
            step("ends", runs, over).within(long, Some(long)),
            step("stop", runs, idle).on(on(1)).within(50, Some(long - 50)),
            step("again", over, idle).on(on(1)),
        ] {
            net.transition(transition).unwrap();
        }
        for place in [idle, runs, over] {
            net.laws.push(OwnedLaw::AlwaysCan(place));
        }
    }
    assert_eq!(verdict(&net), Ok(Known::Explored { markings: 9, firings: 24, settle: 0 }));
    let view = net.view();
    let packed = Packed::<1, 4>::alone(&view.net()).unwrap();
    let graph = Graph::of(&view.net(), &packed.code());
    assert_eq!(graph.classes(), 72);
}

/// A job takes some time and is aborted every five seconds: whether it can end depends on when it
/// was begun, so on a difference of two clocks.
#[test]
fn markings_that_differ_in_differences_of_clocks_are_told_apart() {
    let job = |long, aborts: &str| {
        let mut net = net(vec![], OwnedLaw::AlwaysCan(C));
        let waits = net.place(OwnedPlace::new("Waits", 1).at_most(1)).unwrap();
        let over = net.place(OwnedPlace::new("Over", 0).at_most(1)).unwrap();
        let ends = step("ends", B, C).within(long, Some(long));
        let tick = step("tick", waits, over).within(5_000, Some(5_000));
        let order = if aborts == "first" { [tick, ends] } else { [ends, tick] };
        let abort = step("abort", B, A).take(over, 1).give(waits, 1);
        let others = [abort, step("renew", over, waits), step("go", A, B).on(GO)];
        for transition in order.into_iter().chain(others) {
            net.transition(transition).unwrap();
        }
        net.transition(step("back", C, A).on(BACK)).unwrap();
        net
    };
    for long in [3_000, 4_999] {
        assert!(verdict(&job(long, "first")).is_ok());
    }
    // Begun at the instant of a tick it ends at that of the next one.
    assert!(verdict(&job(5_000, "then")).is_ok());
    for net in [job(5_000, "first"), job(5_001, "then")] {
        assert_eq!(verdict(&net), Err((Culprit::Never { markings: 4 }, vec![])));
    }
}

/// Two timers of five seconds tick at one instant always, or never: it depends on when the second
/// one was begun, and nothing else tells the markings of the two apart.
#[test]
fn classes_that_an_early_choice_separates_are_told_apart() {
    let mut net = net(vec![], OwnedLaw::AlwaysCan(C));
    let mut place = |name, tokens| net.place(OwnedPlace::new(name, tokens).at_most(1)).unwrap();
    let (ticking, mark, ticked) = (place("Ticking", 1), place("Mark", 0), place("Ticked", 0));
    let period = |it: OwnedTransition| it.within(5_000, Some(5_000));
    for transition in [
        OwnedTransition::new("unmark").take(mark, 1).within(1, Some(1)),
        period(step("tick", ticking, ticking).give(mark, 1)),
        step("begin", A, B).on(GO),
        period(step("other", B, ticked)),
        step("hit", ticked, C).read(mark, 1),
        step("miss", ticked, B),
    ] {
        net.transition(transition).unwrap();
    }
    let missed = Err((Culprit::Never { markings: 8 }, vec![Step::Passes(1), fires(2)]));
    assert_eq!(verdict(&net), missed);
}

#[test]
fn an_event_without_answer_names_its_own_transition_that_is_not_open() {
    let lines = vec![
        step("early", A, B).on(GO).within(20, Some(30)),
        step("stays", A, A).on(GO),
        step("late", A, B).on(BACK).within(20, Some(30)),
        step("there", B, B).on(GO),
        step("back", B, A).on(BACK),
    ];
    let (event, closed) = (BACK, Some(TransitionId(2)));
    let unanswered = Culprit::Unanswered { event, closed };
    assert_eq!(verdict(&net(lines, OwnedLaw::HandlesAll)), Err((unanswered, vec![])));
}

#[test]
fn in_another_state_it_is_the_transition_of_that_state() {
    let lines = vec![
        step("goes", A, C).on(GO),
        step("waits", A, A).on(BACK),
        step("there", C, C).on(GO),
        step("late", C, A).on(BACK).within(20, Some(30)),
    ];
    let unanswered = Culprit::Unanswered { event: BACK, closed: Some(TransitionId(3)) };
    let way = vec![fires(0)];
    assert_eq!(verdict(&net(lines, OwnedLaw::HandlesAll)), Err((unanswered, way)));
}

#[test]
fn the_seventieth_event_is_answered_or_not() {
    let hears = |count: u32| {
        let mut net = OwnedNet::new("hears", "");
        net.place(OwnedPlace::new("A", 1).at_most(1)).unwrap();
        for at in 0..70 {
            net.event(&format!("e{at}"), "").unwrap();
        }
        for at in 0..count {
            net.transition(step(&format!("t{at}"), A, A).on(EventId(at))).unwrap();
        }
        net.laws.push(OwnedLaw::HandlesAll);
        net
    };
    assert!(verdict(&hears(70)).is_ok());
    let last = Culprit::Unanswered { event: EventId(69), closed: None };
    assert_eq!(verdict(&hears(69)), Err((last, vec![])));
}

#[test]
fn a_place_refilled_by_a_cycle_grows_and_one_filled_once_does_not() {
    let beyond = |refills: bool| {
        let mut net = OwnedNet::new("cups", "");
        for (name, tokens, most) in [("A", 2, 2), ("B", 0, 1)] {
            net.place(OwnedPlace::new(name, tokens).at_most(most)).unwrap();
        }
        net.event("go", "").unwrap();
        let fills = OwnedTransition::new("fills").on(GO).take(A, 1).give(B, 1);
        net.transition(if refills { fills.give(A, 1) } else { fills }).unwrap();
        verdict(&net).unwrap_err()
    };
    let go = Step::Fires(TransitionId(0));
    let bound = |grows| Culprit::Bound { place: B, tokens: 2, transition: TransitionId(0), grows };
    assert_eq!(beyond(true), (bound(true), vec![go; 2]));
    assert_eq!(beyond(false), (bound(false), vec![go; 2]));
}

/// A change by other nets to the first place of all, or to its complement, is a step on the path.
#[test]
fn a_shared_place_or_its_complement_may_be_the_first_one() {
    for (flag, absent) in [(PlaceId(0), PlaceId(1)), (PlaceId(1), PlaceId(0))] {
        let mut net = OwnedNet::new("asked", "");
        let shared = OwnedPlace { role: Role::Shared, ..OwnedPlace::new("flag", 0) };
        let not = OwnedPlace { role: Role::Complement(flag), ..OwnedPlace::new("not", 1) };
        let places = if flag < absent { [shared, not] } else { [not, shared] };
        for place in places {
            net.place(place.at_most(1)).unwrap();
        }
        let [here, there] = [("Here", 1), ("There", 0)]
            .map(|(name, tokens)| net.place(OwnedPlace::new(name, tokens).at_most(1)).unwrap());
        net.transition(step("goes", here, there).read(flag, 1)).unwrap();
        net.laws.push(OwnedLaw::NeverBoth(there, flag));
        assert_eq!(verdict(&net), Err((Culprit::Both, vec![Step::Raised(flag), fires(0)])));
        let sum = vec![Arc { place: there, weight: 1 }];
        net.laws = vec![OwnedLaw::Invariant { sum, equals: 0 }];
        assert_eq!(verdict(&net), Err((Culprit::Sum(1), vec![Step::Raised(flag), fires(0)])));
    }
}

/// As many markings as there can be: ten switches, and every law.
#[test]
fn every_law_is_judged_in_all_of_1_024_markings() {
    let mut net = OwnedNet::new("switches", "");
    for at in 0..10 {
        let event = net.event(&format!("flip{at}"), "").unwrap();
        let [off, on] = [("off", 1), ("on", 0)].map(|(name, tokens)| {
            net.place(OwnedPlace::new(&format!("{name}{at}"), tokens).at_most(1)).unwrap()
        });
        net.transition(step("up", off, on).on(event)).unwrap();
        net.transition(step("down", on, off).on(event)).unwrap();
    }
    let (off, on) = (PlaceId(18), PlaceId(19));
    let sum = [off, on].map(|place| Arc { place, weight: 1 }).to_vec();
    net.laws = vec![
        OwnedLaw::Invariant { sum, equals: 1 },
        OwnedLaw::NeverBoth(off, on),
        OwnedLaw::Reachable(on),
        OwnedLaw::AlwaysCan(on),
        OwnedLaw::HandlesAll,
        OwnedLaw::Settles,
        OwnedLaw::DeadlockFree { end: None },
        OwnedLaw::Deterministic,
    ];
    let all = Known::Explored { markings: 1_024, firings: 10_240, settle: 0 };
    assert_eq!(verdict(&net), Ok(all));
}
