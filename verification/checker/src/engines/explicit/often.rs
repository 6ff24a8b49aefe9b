//! How often places are marked.

use cotama_property::pt::Pt;

/// Firings of all walks, and of one of them: who walks on for ever ends in the few places that are
/// left for good, which are marked in few markings of all.
const FIRINGS: usize = 2_048;
const WALK: usize = 64;

/// For each place how often it is marked on walks, which are always the same.
pub(super) fn marked_often(pt: &Pt) -> Vec<u32> {
    let (mut marked, mut marking, mut turn) = (vec![0; pt.places.len()], pt.initial.clone(), 0_u32);
    let transitions = pt.transitions.len() as u32;
    for firing in 0..FIRINGS {
        if firing.is_multiple_of(WALK) {
            marking.clone_from(&pt.initial);
        }
        marked.iter_mut().zip(&marking).for_each(|(it, tokens)| *it += u32::from(*tokens > 0));
        turn = turn.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let from = ((u64::from(turn) * u64::from(transitions)) >> 32) as u32;
        let is_ready = |it: &u32| {
            pt.needs.of(*it).iter().all(|&(place, tokens)| marking[place as usize] >= tokens)
        };
        let next = (from..transitions).chain(0..from).find(is_ready);
        let after = next.and_then(|it| pt.fire(&marking, it));
        marking = after.unwrap_or_else(|| pt.initial.clone());
    }
    marked
}
