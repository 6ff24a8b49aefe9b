//! Siphons and traps of random nets, against their definitions and against what markings are
//! reachable.

use super::nets::{any_net, enabled, explore};
use crate::numbered::{Arcs, net};
use cotama_checker::structural::{
    commoner, greatest_siphon, greatest_trap, minimal_siphons, never_marked,
};
use cotama_core::net::PlaceId;
use cotama_verification::pt::Pt;
use proptest::prelude::*;

fn change(pt: &Pt, transition: u32, place: u32) -> i64 {
    pt.effects.of(transition).iter().find(|it| it.0 == place).map_or(0, |it| it.1)
}

fn need(pt: &Pt, transition: u32, place: u32) -> i64 {
    pt.needs.of(transition).iter().find(|it| it.0 == place).map_or(0, |it| it.1.into())
}

fn transitions(pt: &Pt) -> std::ops::Range<u32> {
    0..pt.transitions.len() as u32
}

/// Every transition that adds tokens to the set needs tokens of it.
fn is_siphon(pt: &Pt, set: &[u32]) -> bool {
    transitions(pt).all(|it| {
        set.iter().all(|&place| change(pt, it, place) <= 0)
            || set.iter().any(|&place| need(pt, it, place) > 0)
    })
}

/// Every transition that takes tokens from the set leaves tokens in it.
fn is_trap(pt: &Pt, set: &[u32]) -> bool {
    transitions(pt).all(|it| {
        set.iter().all(|&place| change(pt, it, place) >= 0)
            || set.iter().any(|&place| need(pt, it, place) + change(pt, it, place) > 0)
    })
}

fn subsets(of: &[u32]) -> Vec<Vec<u32>> {
    let pick =
        |code: usize| of.iter().enumerate().filter(move |it| code >> it.0 & 1 == 1).map(|it| *it.1);
    (0..1 << of.len()).map(|code| pick(code).collect()).collect()
}

fn union(sets: impl Iterator<Item = Vec<u32>>) -> Vec<u32> {
    sets.flatten().collect::<std::collections::BTreeSet<_>>().into_iter().collect()
}

fn ids(places: &[PlaceId]) -> Vec<u32> {
    places.iter().map(|it| it.0).collect()
}

proptest! {
    #[test]
    fn the_greatest_ones_contain_all_others(pt in any_net(), code in 0..32_usize) {
        let among: Vec<u32> =
            (0..pt.places.len() as u32).filter(|it| code >> it & 1 == 1).collect();
        let places: Vec<_> = among.iter().map(|&it| PlaceId(it)).collect();
        let siphons = union(subsets(&among).into_iter().filter(|it| is_siphon(&pt, it)));
        let traps = union(subsets(&among).into_iter().filter(|it| is_trap(&pt, it)));
        prop_assert_eq!(ids(&greatest_siphon(&pt, &places)), siphons);
        prop_assert_eq!(ids(&greatest_trap(&pt, &places)), traps);
    }

    #[test]
    fn minimal_siphons_are_all_there_with_their_traps(pt in any_net()) {
        let all: Vec<u32> = (0..pt.places.len() as u32).collect();
        let siphons: Vec<_> =
            subsets(&all).into_iter().filter(|it| !it.is_empty() && is_siphon(&pt, it)).collect();
        let within = |small: &[u32], large: &[u32]| small.iter().all(|it| large.contains(it));
        let mut minimal: Vec<_> =
            siphons
                .iter()
                .filter(|it| !siphons.iter().any(|other| other != *it && within(other, it)))
                .cloned()
                .collect();
        minimal.sort();
        let found = minimal_siphons(&pt, 100, 1_000_000);
        prop_assert!(found.complete);
        let mut places: Vec<_> = found.siphons.iter().map(|it| ids(&it.places)).collect();
        places.sort();
        prop_assert_eq!(places, minimal);
        for siphon in &found.siphons {
            let marked = |set: &Vec<u32>| set.iter().any(|&it| pt.initial[it as usize] > 0);
            let best = subsets(&ids(&siphon.places))
                .into_iter()
                .filter(|it| is_trap(&pt, it) && marked(it));
            match &siphon.trap {
                None => prop_assert_eq!(best.count(), 0),
                Some(trap) => {
                    let trap = ids(&trap.places);
                    prop_assert!(
                        is_trap(&pt, &trap) && marked(&trap) && within(&trap, &ids(&siphon.places))
                    );
                    prop_assert!(best.into_iter().all(|it| it == trap || !within(&it, &trap)));
                }
            }
        }
    }

    #[test]
    fn siphons_stay_empty_and_traps_stay_marked(pt in any_net()) {
        let (markings, _) = explore(&pt, 300);
        let never = never_marked(&pt);
        prop_assert!(markings.iter().all(|it| never.iter().all(|place| it[place.0 as usize] == 0)));
        let traps =
            minimal_siphons(&pt, 100, 1_000_000).siphons.into_iter().filter_map(|it| it.trap);
        for trap in traps {
            prop_assert!(trap.holds(&pt, |_| true));
            prop_assert!(
                markings.iter().all(|it| trap.places.iter().any(|place| it[place.0 as usize] > 0))
            );
        }
    }

    #[test]
    fn the_theorem_of_commoner_is_right(pt in any_net()) {
        let (markings, complete) = explore(&pt, 300);
        let found = commoner(&pt, &minimal_siphons(&pt, 100, 1_000_000));
        if found.deadlock_free == Some(true) {
            prop_assert!(markings.iter().all(|it| enabled(&pt, it).next().is_some()));
        }
        if let Some(live) = found.live && complete {
            prop_assert_eq!(markings.iter().all(|it| {
                let from_here = Pt { initial: it.clone(), ..pt.clone() };
                let (later, _) = explore(&from_here, 300);
                transitions(&pt).all(|transition| later.iter().any(|it| pt.enabled(it, transition)))
            }), live);
        }
    }
}

#[test]
fn a_trap_without_tokens_keeps_no_siphon_marked() {
    // From the marked place to the other one and back; what comes back leaves a token there, so
    // that the other one is a trap.
    let around: [[Arcs<'_>; 3]; 2] = [[&[(0, 1)], &[], &[(1, 1)]], [&[], &[(1, 1)], &[(0, 1)]]];
    let found = minimal_siphons(&net(&[1, 0], &around), 100, 1_000_000);
    let [siphon] = &found.siphons[..] else { panic!("{found:?}") };
    assert_eq!(ids(&siphon.places), [0, 1]);
    assert_eq!(siphon.trap.as_ref().map(|it| ids(&it.places)), Some(vec![0, 1]));
    // The marked place may lose its token before any comes to the trap.
    let lost = [&around[..], &[[&[(0, 1)], &[], &[]]]].concat();
    let found = minimal_siphons(&net(&[1, 0], &lost), 100, 1_000_000);
    assert_eq!(found.siphons.iter().map(|it| it.trap.is_some()).collect::<Vec<_>>(), [false]);
}
