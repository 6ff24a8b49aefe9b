//! How often places are marked.

use crate::pt::Pt;

/// Firings of a walk.
const WALK: usize = 512;

/// For each place how often it is marked on a walk, which is always the same.
pub(super) fn marked_often(pt: &Pt) -> Vec<u32> {
    let (mut marked, mut marking, mut turn) = (vec![0; pt.places.len()], pt.initial.clone(), 0_u32);
    let transitions = pt.transitions.len() as u32;
    for _ in 0..WALK {
        marked.iter_mut().zip(&marking).for_each(|(it, tokens)| *it += u32::from(*tokens > 0));
        turn = turn.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let from = ((u64::from(turn) * u64::from(transitions)) >> 32) as u32;
        let next = (from..transitions).chain(0..from).find(|it| pt.enabled(&marking, *it));
        let after = next.and_then(|it| pt.fire(&marking, it));
        marking = after.unwrap_or_else(|| pt.initial.clone());
    }
    marked
}
