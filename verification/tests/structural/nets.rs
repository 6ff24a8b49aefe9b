//! Nets to look at.

use crate::numbered::{Arcs, net};
use cotama_core::net::PlaceId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::pt::Pt;
use proptest::collection::vec;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Philosophers who take one fork after the other. If they keep an order, the last one is the only
/// one to begin on the other side. Places of each: thinks, fork, has the first fork, eats.
pub(crate) fn philosophers(count: usize, ordered: bool) -> Pt {
    let mut net = OwnedNet::new("philosophers", "");
    for at in 0..count {
        for (name, tokens) in [("thinks", 1), ("fork", 1), ("waits", 0), ("eats", 0)] {
            net.place(OwnedPlace::new(&format!("{name} {at}"), tokens)).unwrap();
        }
    }
    let place = |at: usize, which: usize| PlaceId((4 * (at % count) + which) as u32);
    for at in 0..count {
        let [thinks, mine, waits, eats] = [0, 1, 2, 3].map(|which| place(at, which));
        let theirs = place(at + 1, 1);
        let (first, second) =
            if ordered && at + 1 == count { (theirs, mine) } else { (mine, theirs) };
        let named = |what: &str| OwnedTransition::new(&format!("{what} {at}"));
        net.transition(named("begin").take(thinks, 1).take(first, 1).give(waits, 1)).unwrap();
        net.transition(named("eat").take(waits, 1).take(second, 1).give(eats, 1)).unwrap();
        net.transition(named("end").take(eats, 1).give(thinks, 1).give(mine, 1).give(theirs, 1))
            .unwrap();
    }
    Pt::from(&net.view().net())
}

/// The Kanban system of four cells with `cards` cards each (Ciardo and Tilgner). Places of each
/// cell: works, broken, done, cards.
pub(crate) fn kanban(cards: u32) -> Pt {
    let mut initial = [0; 16];
    for cell in 0..4 {
        initial[4 * cell + 3] = cards;
    }
    let [works, broken, done, free] =
        [0, 1, 2, 3].map(|which| move |cell: u32| (4 * cell + which, 1));
    let mut arcs: Vec<(Vec<_>, Vec<_>)> = vec![
        (vec![free(0)], vec![works(0)]),
        (vec![done(0), free(1), free(2)], vec![free(0), works(1), works(2)]),
        (vec![done(1), done(2), free(3)], vec![free(1), free(2), works(3)]),
        (vec![done(3)], vec![free(3)]),
    ];
    for cell in 0..4 {
        arcs.push((vec![works(cell)], vec![done(cell)]));
        arcs.push((vec![works(cell)], vec![broken(cell)]));
        arcs.push((vec![broken(cell)], vec![works(cell)]));
    }
    let arcs: Vec<[Arcs<'_>; 3]> =
        arcs.iter().map(|(take, give)| [&take[..], &[], &give[..]]).collect();
    net(&initial, &arcs)
}

/// Reachable markings, at most `limit`, and whether these are all.
pub(crate) fn explore(pt: &Pt, limit: usize) -> (BTreeSet<Vec<u32>>, bool) {
    let mut seen = BTreeSet::from([pt.initial.clone()]);
    let mut open = vec![pt.initial.clone()];
    while let Some(marking) = open.pop() {
        for transition in enabled(pt, &marking) {
            let Some(after) = pt.fire(&marking, transition) else { return (seen, false) };
            if !seen.contains(&after) {
                if seen.len() == limit {
                    return (seen, false);
                }
                seen.insert(after.clone());
                open.push(after);
            }
        }
    }
    (seen, true)
}

/// The transitions that can fire.
pub(crate) fn enabled<'a>(pt: &'a Pt, marking: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
    (0..pt.transitions.len() as u32).filter(|&it| pt.enabled(marking, it))
}

/// The marking after a firing sequence, every step of which must be enabled.
pub(crate) fn replay(pt: &Pt, trace: &[cotama_core::net::TransitionId]) -> Vec<u32> {
    trace.iter().fold(pt.initial.clone(), |marking, it| {
        assert!(pt.enabled(&marking, it.0), "{} is not enabled", pt.transitions[it.0 as usize]);
        pt.fire(&marking, it.0).unwrap()
    })
}

/// Small nets of all kinds, with weights, reads and choices.
pub(crate) fn any_net() -> impl Strategy<Value = Pt> {
    let arcs = |most: usize| vec((0..5_u32, 1..=2_u32), 0..=most);
    let transition = (arcs(3), arcs(1), arcs(3));
    (vec(0..=2_u32, 1..=5), vec(transition, 1..=6)).prop_map(|(initial, transitions)| {
        let places = initial.len() as u32;
        let within = |arcs: Vec<(u32, u32)>| {
            let arcs = arcs.into_iter().map(|(place, weight)| (place % places, weight));
            arcs.collect::<BTreeMap<_, _>>().into_iter().collect::<Vec<_>>()
        };
        let all: Vec<_> = transitions
            .into_iter()
            .map(|(take, read, give)| (within(take), within(read), within(give)))
            .collect();
        let all: Vec<[Arcs<'_>; 3]> =
            all.iter().map(|(take, read, give)| [&take[..], &read[..], &give[..]]).collect();
        net(&initial, &all)
    })
}
