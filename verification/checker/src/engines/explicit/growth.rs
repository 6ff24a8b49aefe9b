//! Tokens that grow without end.

use super::Limits;
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;
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
///
/// Firings can be repeated where no place that grows keeps one of them from firing or is emptied by
/// it, and no transition that grown places enable goes before them.
pub(super) fn growth(pt: &Pt, limits: &Limits) -> Option<Growth> {
    if pt.special.as_ref().is_some_and(|it| it.has_priorities()) {
        return None;
    }
    // Each is on the way and among those that were met.
    let bytes = 2 * (size_of_val(&pt.initial[..]) as u64 + 64);
    let most = MARKINGS.min(usize::try_from(limits.bytes / 2 / bytes).unwrap_or(MARKINGS));
    let transitions = pt.transitions.len() as u32;
    let mut met = HashSet::from([pt.initial.clone()]);
    let mut path = vec![(pt.initial.clone(), 0)];
    while let Some((marking, next)) = path.last_mut() {
        let Some(transition) = (*next..transitions).find(|it| pt.enabled(marking, *it)) else {
            path.pop();
            continue;
        };
        *next = transition + 1;
        let Some(after) = pt.fire(marking, transition) else { continue };
        // A marking of the way is left by the transition before the next one.
        let fired = |at: usize| path[at..].iter().map(|(_, next)| TransitionId(next - 1));
        let grows = |at: &usize| {
            let before = &path[*at].0;
            let is_more = before.iter().zip(&after).all(|(before, after)| before <= after);
            let stays = |place: u32| before[place as usize] == after[place as usize];
            let again = |it: TransitionId| {
                let mut both = pt.inhibits(it.0).iter().chain(pt.resets(it.0));
                both.all(|it| stays(it.0))
            };
            is_more && *before != after && (pt.is_plain() || fired(*at).all(again))
        };
        if let Some(at) = (0..path.len()).rev().find(grows) {
            let mut first: Vec<_> = fired(0).collect();
            let repeated = first.split_off(at);
            return Some(Growth { first, repeated });
        }
        if met.len() >= most || limits.is_over() {
            return None;
        }
        if path.len() < DEPTH && met.insert(after.clone()) {
            path.push((after, 0));
        }
    }
    None
}
