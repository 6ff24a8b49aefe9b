//! Places that are filled when they are needed go.

use super::draft::{Draft, Move};
use crate::components::components;
use std::collections::BTreeMap;

/// Takes away the places that transitions fill that need nothing.
pub(super) fn sources(draft: &mut Draft, names: &mut Vec<String>) -> usize {
    let mut supply = draft.supply();
    for (at, (_, it)) in draft.transitions().enumerate() {
        if it.needs.is_empty() && !draft.is_visible(it) {
            for &(place, _) in &it.effects {
                supply.fills.entry(place).or_insert_with(|| vec![(at as u32, None)]);
            }
        }
    }
    let filled: Vec<u32> = supply.fills.keys().copied().collect();
    if !filled.is_empty() {
        draft.supplied(supply, names);
    }
    for &place in &filled {
        draft.drop_place(place);
    }
    filled.len()
}

/// From where to where a transition moves one token, if that is all it does, out of sight.
fn free_move(draft: &Draft, transition: &Move) -> Option<(u32, u32)> {
    let (&[(from, 1)], &[a, b]) = (transition.needs.as_slice(), transition.effects.as_slice())
    else {
        return None;
    };
    let (from, to) = match (a, b) {
        ((place, -1), (to, 1)) | ((to, 1), (place, -1)) if place == from => (from, to),
        _ => return None,
    };
    (!draft.is_visible(transition)).then_some((from, to))
}

/// Makes one place of those among which tokens move freely.
pub(super) fn free_cycles(draft: &mut Draft, names: &mut Vec<String>) -> usize {
    let mut edges = vec![Vec::new(); draft.present.len()];
    let mut moves = Vec::new();
    for (at, (_, it)) in draft.transitions().enumerate() {
        if let Some((from, to)) = free_move(draft, it) {
            edges[from as usize].push(to);
            moves.push((at as u32, from, to));
        }
    }
    let component =
        components(edges.len(), |node, at| edges[node as usize].get(at as usize).copied()).of;
    let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for place in draft.places() {
        members.entry(component[place as usize]).or_default().push(place);
    }
    members.retain(|_, places| places.len() > 1 && fits(draft, places));
    if members.is_empty() {
        return 0;
    }
    let mut supply = draft.supply();
    for &(at, from, to) in &moves {
        if component[from as usize] == component[to as usize]
            && members.contains_key(&component[to as usize])
        {
            supply.fills.entry(to).or_default().push((at, Some(from)));
        }
    }
    draft.supplied(supply, names);
    let mut merged = 0;
    for places in members.values() {
        merged += places.len() - 1;
        for &place in &places[1..] {
            merge(draft, place, places[0]);
        }
    }
    merged
}

/// Whether the numbers of these places together are small enough.
fn fits(draft: &Draft, places: &[u32]) -> bool {
    let tokens: u64 = places.iter().map(|&it| u64::from(draft.initial[it as usize])).sum();
    let mut needs: BTreeMap<u32, u64> = BTreeMap::new();
    for &place in places {
        for (at, it) in draft.users(place) {
            *needs.entry(at).or_default() +=
                u64::from(it.need(place)) + it.effect(place).unsigned_abs();
        }
    }
    needs.values().chain([&tokens]).all(|&it| u32::try_from(it).is_ok())
}

fn merge(draft: &mut Draft, place: u32, into: u32) {
    draft.initial[into as usize] += draft.initial[place as usize];
    for at in draft.users[place as usize].clone() {
        let Some(mut it) = draft.remove(at) else { continue };
        let (need, by) = (it.need(place) + it.need(into), it.effect(place) + it.effect(into));
        it.needs.retain(|it| it.0 != place && it.0 != into);
        it.effects.retain(|it| it.0 != place && it.0 != into);
        if need > 0 {
            it.needs.push((into, need));
            it.needs.sort_unstable();
        }
        if by != 0 {
            it.effects.push((into, by));
            it.effects.sort_unstable();
        }
        draft.put(at, it);
    }
    draft.drop_place(place);
}
