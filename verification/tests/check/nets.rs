//! Small random nets.

use crate::properties::random::Random;
use cotama_core::net::PlaceId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::pt::Pt;
use std::collections::BTreeSet;

/// A net with up to five places and transitions, with weights and read arcs; every other one makes
/// no tokens.
pub(crate) fn any(random: &mut Random) -> Pt {
    let mut net = OwnedNet::new("any", "");
    let places: Vec<_> = (0..2 + random.below(4))
        .map(|at| {
            net.place(OwnedPlace::new(&format!("p{at}"), *random.choose(&[0, 0, 1, 1, 1, 2, 3])))
                .unwrap()
        })
        .collect();
    let keeps = random.below(2) == 0;
    for at in 0..2 + random.below(4) {
        let mut transition = OwnedTransition::new(&format!("t{at}"));
        let count = 1 + random.below(2);
        let takes = arcs(random, &places, count);
        let mut left = takes.iter().map(|it| it.1).sum::<u32>();
        for &(place, weight) in &takes {
            transition = transition.take(place, weight);
        }
        let gives = random.below(3);
        for (place, weight) in arcs(random, &places, gives) {
            let weight = if keeps { weight.min(left) } else { weight };
            left = left.saturating_sub(weight);
            transition = if weight > 0 { transition.give(place, weight) } else { transition };
        }
        let free = |it: &&PlaceId| takes.iter().all(|taken| taken.0 != **it);
        let reads: Vec<PlaceId> = places.iter().filter(free).copied().collect();
        if !reads.is_empty() && random.below(5) == 0 {
            transition = transition.read(*random.choose(&reads), *random.choose(&[1, 1, 2]));
        }
        net.transition(transition).unwrap();
    }
    Pt::from(&net.view().net())
}

/// So many different places with weights, mostly 1.
fn arcs(random: &mut Random, places: &[PlaceId], count: usize) -> Vec<(PlaceId, u32)> {
    let mut left = places.to_vec();
    (0..count)
        .map_while(|_| {
            let at = (!left.is_empty()).then(|| random.below(left.len()))?;
            Some((left.swap_remove(at), *random.choose(&[1, 1, 1, 1, 2, 3])))
        })
        .collect()
}

/// All reachable markings; `None` when there are more than so many.
pub(crate) fn markings(pt: &Pt, most: usize) -> Option<BTreeSet<Vec<u32>>> {
    let mut markings = BTreeSet::from([pt.initial.clone()]);
    let mut waiting = vec![pt.initial.clone()];
    while let Some(marking) = waiting.pop() {
        for transition in (0..pt.transitions.len() as u32).filter(|&it| pt.enabled(&marking, it)) {
            let after = pt.fire(&marking, transition)?;
            if markings.insert(after.clone()) {
                waiting.push(after);
            }
        }
        if markings.len() > most {
            return None;
        }
    }
    Some(markings)
}
