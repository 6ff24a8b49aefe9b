//! The same counterexample with fewer firings.

use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;
use std::collections::HashMap;

/// The most firings that are tried in all.
const TRIED: usize = 20_000_000;

/// Leaves out of a firing sequence what its goal does not need. What is left can be fired from the
/// initial marking and leads to a marking that meets the goal; without any one of its firings it
/// would not (unless the work was cut short, after about 20 million firings). It need not be the
/// shortest one that there is. A sequence that cannot be fired, or meets the goal nowhere, comes
/// back as it is.
///
/// First what follows the first marking that meets the goal is cut off, then loops are cut out,
/// then runs of firings are left out as long as that succeeds, long ones first (Zeller and
/// Hildebrandt, "Simplifying and isolating failure-inducing input", IEEE TSE 28(2), 2002).
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::{diagnosis::shrink, pt::Pt};
///
/// let mut net = OwnedNet::new("lamps", "");
/// for name in ["left", "right"] {
///     let [off, on] = [("off", 1), ("on", 0)].map(|it| {
///         net.place(OwnedPlace::new(&format!("{name}_{}", it.0), it.1)).unwrap()
///     });
///     net.transition(OwnedTransition::new(name).take(off, 1).give(on, 1)).unwrap();
/// }
/// let pt = Pt::from(&net.view().net());
/// let [left, right] = ["left", "right"].map(|it| pt.transition(it).unwrap());
/// assert_eq!(shrink(&pt, &[left, right], |marking| marking[3] > 0), [right]);
/// ```
pub fn shrink(
    pt: &Pt,
    trace: &[TransitionId],
    mut goal: impl FnMut(&[u32]) -> bool,
) -> Vec<TransitionId> {
    let Some(mut kept) = cut(pt, trace, &mut goal) else { return trace.to_vec() };
    let mut tried = 0;
    let mut length = kept.len().div_ceil(2);
    while length > 0 {
        let mut at = 0;
        let mut removed = false;
        while at < kept.len() {
            let rest = || kept[..at].iter().chain(&kept[(at + length).min(kept.len())..]);
            tried += kept.len();
            if tried > TRIED {
                return kept;
            }
            if last(pt, rest()).is_some_and(|marking| goal(&marking)) {
                kept = rest().copied().collect();
                removed = true;
            } else {
                at += length;
            }
        }
        // Single firings again and again, until none can be left out.
        length = if length == 1 { usize::from(removed) } else { length.div_ceil(2) };
    }
    kept
}

/// Up to the first marking that meets the goal, without loops.
fn cut(
    pt: &Pt,
    trace: &[TransitionId],
    goal: &mut impl FnMut(&[u32]) -> bool,
) -> Option<Vec<TransitionId>> {
    let mut kept: Vec<TransitionId> = Vec::new();
    let mut markings = vec![pt.initial.clone()];
    let mut met = HashMap::from([(pt.initial.clone(), 0)]);
    let mut fire = trace.iter();
    while !goal(&markings[kept.len()]) {
        let transition = *fire.next()?;
        let after = fired(pt, &markings[kept.len()], transition)?;
        if let Some(&at) = met.get(&after) {
            for left in markings.drain(at + 1..) {
                met.remove(&left);
            }
            kept.truncate(at);
        } else {
            kept.push(transition);
            met.insert(after.clone(), kept.len());
            markings.push(after);
        }
    }
    Some(kept)
}

fn fired(pt: &Pt, marking: &[u32], TransitionId(transition): TransitionId) -> Option<Vec<u32>> {
    let can = (transition as usize) < pt.transitions.len() && pt.enabled(marking, transition);
    can.then(|| pt.fire(marking, transition)).flatten()
}

fn last<'t>(pt: &Pt, mut trace: impl Iterator<Item = &'t TransitionId>) -> Option<Vec<u32>> {
    trace.try_fold(pt.initial.clone(), |marking, it| fired(pt, &marking, *it))
}
