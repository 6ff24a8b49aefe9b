//! Simple methods to compare with.

use cotama_fuzz::split_mix;
use cotama_verification::coverability::Tokens;
use cotama_verification::pt::Pt;
use std::collections::BTreeSet;

/// Numbers that look random, the same ones for the same seed.
pub(crate) struct Draw(pub(crate) u64);

impl Draw {
    pub(crate) fn below(&mut self, end: u32) -> u32 {
        (split_mix(&mut self.0) % u64::from(end)) as u32
    }

    /// Some places, each once, with weights: mostly 1.
    fn arcs(&mut self, places: u32, least: u32, most: u32) -> Vec<(u32, u32)> {
        let mut arcs: Vec<(u32, u32)> = Vec::new();
        for _ in 0..least + self.below(most + 1 - least) {
            let place = self.below(places);
            let weight = [1, 1, 1, 1, 2][self.below(5) as usize];
            if arcs.iter().all(|it| it.0 != place) {
                arcs.push((place, weight));
            }
        }
        arcs
    }
}

/// A small net.
pub(crate) fn random(seed: u64) -> Pt {
    let mut draw = Draw(seed);
    let places = 2 + draw.below(5);
    let transitions = 1 + draw.below(7);
    let initial: Vec<u32> =
        (0..places).map(|_| [0, 0, 0, 1, 1, 2][draw.below(6) as usize]).collect();
    let keeps = draw.below(4) == 0;
    let arcs: Vec<[Vec<(u32, u32)>; 2]> = (0..transitions)
        .map(|_| {
            let least = u32::from(draw.below(16) > 0);
            let take = draw.arcs(places, least, 3);
            let mut give = draw.arcs(places, 0, 3);
            if keeps {
                give.truncate(take.len());
                for arc in &mut give {
                    arc.1 = 1;
                }
            }
            [take, give]
        })
        .collect();
    let arcs: Vec<[&[(u32, u32)]; 2]> =
        arcs.iter().map(|it| [it[0].as_slice(), it[1].as_slice()]).collect();
    super::net(&initial, &arcs)
}

/// All reachable markings; `None` when there are more than so many.
pub(crate) fn reachable(pt: &Pt, most: usize) -> Option<BTreeSet<Vec<u32>>> {
    let mut markings = BTreeSet::from([pt.initial.clone()]);
    let mut waiting = vec![pt.initial.clone()];
    while let Some(marking) = waiting.pop() {
        for transition in (0..pt.transitions.len() as u32).filter(|&it| pt.enabled(&marking, it)) {
            let after = pt.fire(&marking, transition).unwrap();
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

/// Whether a marking is coverable, backwards (P. A. Abdulla, K. Cerans, B. Jonsson, Y.-K. Tsay,
/// General decidability theorems for infinite-state systems, LICS 1996): the smallest markings from
/// which it can be covered, until there are no new ones. `None` when they get too many.
pub(crate) fn backward(pt: &Pt, target: &[u64]) -> Option<bool> {
    let mut smallest = vec![target.to_vec()];
    let mut waiting = smallest.clone();
    while let Some(marking) = waiting.pop() {
        if !smallest.contains(&marking) {
            continue;
        }
        for transition in 0..pt.transitions.len() as u32 {
            let mut before = marking.clone();
            for &(place, change) in pt.effects.of(transition) {
                let tokens = &mut before[place as usize];
                *tokens = if change > 0 {
                    tokens.saturating_sub(change.unsigned_abs())
                } else {
                    *tokens + change.unsigned_abs()
                };
            }
            for &(place, tokens) in pt.needs.of(transition) {
                before[place as usize] = before[place as usize].max(u64::from(tokens));
            }
            let is_at_most =
                |one: &[u64], other: &[u64]| one.iter().zip(other).all(|(a, b)| a <= b);
            if !smallest.iter().any(|it| is_at_most(it, &before)) {
                smallest.retain(|it| !is_at_most(&before, it));
                smallest.push(before.clone());
                waiting.push(before);
            }
        }
        if smallest.len() > 500 {
            return None;
        }
    }
    let start: Vec<u64> = pt.initial.iter().map(|&it| u64::from(it)).collect();
    Some(smallest.iter().any(|it| it.iter().zip(&start).all(|(a, b)| a <= b)))
}

/// The limit of a marking after a transition, if that is enabled.
pub(crate) fn after(pt: &Pt, marking: &[Tokens], transition: u32) -> Option<Vec<Tokens>> {
    let needs = pt.needs.of(transition).iter();
    needs.clone().all(|&(place, tokens)| marking[place as usize] >= Tokens::from(tokens)).then(
        || {
            let mut after = marking.to_vec();
            for &(place, change) in pt.effects.of(transition) {
                after[place as usize] = after[place as usize].changed(change).unwrap();
            }
            after
        },
    )
}

pub(crate) fn at_most(one: &[Tokens], other: &[Tokens]) -> bool {
    one.iter().zip(other).all(|(one, other)| one <= other)
}

/// Whether markings cover the initial one and all that follow from them: then they cover all
/// reachable ones.
pub(crate) fn covers_all(pt: &Pt, markings: &[Vec<Tokens>]) -> bool {
    let is_covered = |marking: &[Tokens]| markings.iter().any(|it| at_most(marking, it));
    let start: Vec<Tokens> = pt.initial.iter().map(|&it| Tokens::from(it)).collect();
    let transitions = 0..pt.transitions.len() as u32;
    is_covered(&start)
        && markings.iter().all(|it| {
            transitions
                .clone()
                .filter_map(|transition| after(pt, it, transition))
                .all(|it| is_covered(&it))
        })
}
