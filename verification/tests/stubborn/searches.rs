//! Random nets, textbook nets, and limits.

use super::{ends_in, fired};
use crate::properties::oracle::Space;
use crate::properties::random::{Random, net, state};
use cotama_checker::stubborn::{deadlock, reach_reduced};
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_models::nets::families::{kanban, philosophers};
use cotama_verification::explicit::{Limit, Limits, Reached};
use cotama_verification::property::{Atom, Formula, Linear};
use cotama_verification::pt::Pt;

const DEADLOCK: Formula = Formula::Atom(Atom::Deadlock);

/// A net with more places and concurrency than those of the formulas: up to 7 places, tokens and
/// weights up to 3.
fn larger(random: &mut Random) -> Pt {
    let mut net = OwnedNet::new("larger", "");
    let places: Vec<_> = (0..3 + random.below(5))
        .map(|at| net.place(OwnedPlace::new(&format!("p{at}"), random.below(4) as u32)).unwrap())
        .collect();
    for at in 0..3 + random.below(5) {
        let mut transition = OwnedTransition::new(&format!("t{at}"));
        let (mut from, mut to) = (places.clone(), places.clone());
        let mut taken = 0;
        for _ in 0..=random.below(2) {
            let weight = 1 + random.below(3) as u32 / 2;
            transition = transition.take(from.swap_remove(random.below(from.len())), weight);
            taken += weight;
        }
        for _ in 0..random.below(3) {
            let weight = (1 + random.below(3) as u32 / 2).min(taken);
            if weight > 0 {
                transition = transition.give(to.swap_remove(random.below(to.len())), weight);
                taken -= weight;
            }
        }
        if random.below(4) == 0 {
            transition = transition.read(*random.choose(&from), 1 + random.below(2) as u32);
        }
        net.transition(transition).unwrap();
    }
    Pt::from(&net.view().net())
}

fn compared(pt: &Pt, goal: &Formula, reached: &Reached, states: usize, expected: bool) -> usize {
    match reached {
        Reached::Trace { transitions, .. } => {
            assert!(expected && ends_in(pt, transitions, goal), "{goal:?} {pt:?}");
        }
        Reached::Never { states: met } => {
            assert!(!expected, "{} of {pt:?}", goal.display(pt));
            assert!(*met <= states as u64);
        }
        Reached::Unknown { .. } => panic!("{reached:?}"),
    }
    usize::from(reached.states() < states as u64)
}

#[test]
fn deadlocks_are_those_of_the_oracle() {
    let (mut random, mut smaller, mut dead) = (Random(3), 0, 0);
    for round in 0..5_000 {
        let pt = if round % 2 == 0 { net(&mut random) } else { larger(&mut random) };
        let space = Space::new(&pt);
        let expected = space.successors.iter().any(Vec::is_empty);
        dead += usize::from(expected);
        let reached = deadlock(&pt, &Limits::default(), &|_| ());
        smaller += compared(&pt, &DEADLOCK, &reached, space.markings.len(), expected);
        assert_eq!(reach_reduced(&pt, &DEADLOCK, &Limits::default(), &|_| ()), Some(reached));
    }
    assert!(smaller > 1_500 && (1_000..4_900).contains(&dead), "{smaller} {dead}");
}

#[test]
fn reachable_markings_are_those_of_the_oracle() {
    let (mut random, mut smaller, mut never) = (Random(4), 0, 0);
    for round in 0..5_000 {
        let pt = if round % 2 == 0 { net(&mut random) } else { larger(&mut random) };
        let space = Space::new(&pt);
        for depth in 0..3 {
            let goal = state(&mut random, &pt, depth);
            let expected = space.satisfying(&goal).contains(&true);
            let reached = reach_reduced(&pt, &goal, &Limits::default(), &|_| ()).unwrap();
            let less = compared(&pt, &goal, &reached, space.markings.len(), expected);
            (smaller, never) =
                if expected { (smaller, never) } else { (smaller + less, never + 1) };
        }
    }
    assert!(smaller > 1_000 && never > 2_000, "{smaller} {never}");
}

#[test]
fn a_certain_marking_is_found_or_shown_to_be_out_of_reach() {
    let (mut random, mut smaller, mut never) = (Random(5), 0, 0);
    for _ in 0..2_000 {
        let pt = larger(&mut random);
        let space = Space::new(&pt);
        let mut marking = random.choose(&space.markings).clone();
        if random.below(2) == 0 {
            *marking.first_mut().unwrap() += 1;
        }
        let exactly = |(place, &tokens): (usize, &u32)| {
            let weights = |weight| vec![(PlaceId(place as u32), weight)];
            let most = Linear { constant: -i64::from(tokens), weights: weights(1) };
            let least = Linear { constant: tokens.into(), weights: weights(-1) };
            [most, least].map(|it| Formula::Atom(Atom::AtMost(it)))
        };
        let goal = Formula::And(marking.iter().enumerate().flat_map(exactly).collect());
        let expected = space.markings.contains(&marking);
        let reached = reach_reduced(&pt, &goal, &Limits::default(), &|_| ()).unwrap();
        let less = compared(&pt, &goal, &reached, space.markings.len(), expected);
        (smaller, never) = if expected { (smaller, never) } else { (smaller + less, never + 1) };
    }
    assert!(smaller > 300 && never > 400, "{smaller} {never}");
}

#[test]
fn two_hundred_philosophers_starve_after_two_hundred_firings() {
    let pt = Pt::from(&philosophers(200).unwrap().view().net());
    let Reached::Trace { transitions, states } = deadlock(&pt, &Limits::default(), &|_| ()) else {
        panic!("no deadlock")
    };
    assert!(ends_in(&pt, &transitions, &DEADLOCK));
    assert_eq!((transitions.len(), states), (200, 40_200));
}

#[test]
fn a_philosopher_eats_whatever_the_others_do() {
    let pt = Pt::from(&philosophers(200).unwrap().view().net());
    let eats = Formula::Atom(Atom::Fireable(vec![TransitionId(4)]));
    let reached = reach_reduced(&pt, &eats, &Limits::default(), &|_| ()).unwrap();
    let Reached::Trace { transitions, states } = reached else { panic!("{reached:?}") };
    assert!(pt.enabled(&fired(&pt, &transitions), 4));
    assert!(states < 2_000, "{states}");
}

#[test]
fn a_kanban_system_never_stops() {
    let pt = Pt::from(&kanban(2).unwrap().view().net());
    let Reached::Never { states } = deadlock(&pt, &Limits::default(), &|_| ()) else {
        panic!("a deadlock")
    };
    assert!(states < 4_600, "{states}");
}

#[test]
fn a_goal_that_holds_at_the_start_needs_no_firing() {
    let pt = Pt::from(&kanban(2).unwrap().view().net());
    let start = Reached::Trace { transitions: vec![], states: 1 };
    assert_eq!(reach_reduced(&pt, &Formula::TRUE, &Limits::default(), &|_| ()), Some(start));
    let nowhere = Reached::Never { states: 1 };
    assert_eq!(reach_reduced(&pt, &Formula::FALSE, &Limits::default(), &|_| ()), Some(nowhere));
    let run = Formula::Exists(Formula::Finally(Formula::TRUE.into()).into());
    assert_eq!(reach_reduced(&pt, &run, &Limits::default(), &|_| ()), None);
}

/// A source that fills a place, and a sink.
fn fountain() -> Pt {
    let mut net = OwnedNet::new("fountain", "");
    let basin = net.place(OwnedPlace::new("basin", 0)).unwrap();
    let spout = net.place(OwnedPlace::new("spout", 1)).unwrap();
    net.transition(OwnedTransition::new("spout").read(spout, 1).give(basin, 1)).unwrap();
    Pt::from(&net.view().net())
}

#[test]
fn an_unbounded_place_is_followed_beyond_the_first_guess_of_its_width() {
    let full =
        Formula::Atom(Atom::AtMost(Linear { constant: 1_000, weights: vec![(PlaceId(0), -1)] }));
    let reached = reach_reduced(&fountain(), &full, &Limits::default(), &|_| ()).unwrap();
    assert_eq!(
        reached,
        Reached::Trace { transitions: vec![TransitionId(0); 1_000], states: 1_001 }
    );
}

#[test]
fn limits_are_answers() {
    let limits = Limits { states: 50, ..Limits::default() };
    let unknown = Reached::Unknown { limit: Limit::States, states: 50 };
    assert_eq!(deadlock(&fountain(), &limits, &|_| ()), unknown);
    let limits = Limits { bytes: 100_000, ..Limits::default() };
    let Reached::Unknown { limit: Limit::Bytes, states } = deadlock(&fountain(), &limits, &|_| ())
    else {
        panic!("no limit")
    };
    assert!((900..1_100).contains(&states), "{states}");
    let limits = Limits { deadline: Some(std::time::Instant::now()), ..Limits::default() };
    let unknown = Reached::Unknown { limit: Limit::Time, states: 1 };
    assert_eq!(deadlock(&fountain(), &limits, &|_| ()), unknown);
}
