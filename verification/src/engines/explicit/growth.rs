//! Tokens that grow without end.

use super::Limits;
use crate::pt::Pt;
use cotama_core::net::TransitionId;
use std::collections::HashSet;

/// The most markings that a search for growth passes through.
const MARKINGS: usize = 20_000;
/// The most firings it is away from the initial marking.
const DEPTH: usize = 2_000;

/// A proof that a net is unbounded: firings that can be repeated for ever, and add tokens each
/// time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Growth {
    /// From the initial marking to one from which the others can be repeated.
    pub first: Vec<TransitionId>,
    /// Firings after which every place has at least as many tokens as before, and some place has
    /// more.
    pub repeated: Vec<TransitionId>,
}

/// Searches a little for growth, depth first; `None` proves nothing.
pub(super) fn growth(pt: &Pt, limits: &Limits) -> Option<Growth> {
    // Each is on the way and among those that were met.
    let bytes = 2 * (size_of_val(&pt.initial[..]) as u64 + 64);
    let most = MARKINGS.min(usize::try_from(limits.bytes / 2 / bytes).unwrap_or(MARKINGS));
    let transitions = pt.transitions.len() as u32;
    let mut met = HashSet::from([pt.initial.clone()]);
    let mut way = vec![(pt.initial.clone(), 0)];
    while let Some((marking, next)) = way.last_mut() {
        let Some(transition) = (*next..transitions).find(|it| pt.enabled(marking, *it)) else {
            way.pop();
            continue;
        };
        *next = transition + 1;
        let Some(after) = pt.fire(marking, transition) else { continue };
        let covers = |before: &[u32]| {
            let grows = before.iter().zip(&after).try_fold(false, |grows, (before, after)| {
                (before <= after).then_some(grows || before < after)
            });
            grows == Some(true)
        };
        if let Some(at) = way.iter().rposition(|(before, _)| covers(before)) {
            // A marking of the way is left by the transition before the next one.
            let mut first: Vec<_> = way.iter().map(|(_, next)| TransitionId(next - 1)).collect();
            let repeated = first.split_off(at);
            return Some(Growth { first, repeated });
        }
        if met.len() >= most || limits.is_over() {
            return None;
        }
        if way.len() < DEPTH && met.insert(after.clone()) {
            way.push((after, 0));
        }
    }
    None
}
