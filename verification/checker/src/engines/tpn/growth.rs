//! Whether tokens grow without end.

use super::classes::{ClassId, Classes};
use super::markings::Markings;

/// How many classes back a repetition is looked for. A longer one goes unnoticed, and the net
/// counts as unknown.
const BACK: usize = 256;

/// Whether the path to a class, the last one met, ends in a firing sequence that can be repeated
/// for ever and adds tokens.
///
/// Let it lead from (m, D) to (m + d, D), d >= 0, d != 0. If on its way no transition that is
/// disabled, in a marking or in an intermediate one, would be enabled by more tokens in the places
/// of d, then with any multiple of d added the same transitions are enabled and newly enabled all
/// the way: the domains are the same, so it leads to (m + 2d, D), and so on.
pub(super) fn repeats(classes: &Classes, last: ClassId) -> bool {
    let (marking, domain) = classes.list[last as usize];
    let mut class = last;
    for _ in 0..BACK {
        if class == 0 {
            return false;
        }
        class = classes.parents[class as usize].0;
        let (before, same) = classes.list[class as usize];
        if same == domain && before != marking && smaller(&classes.markings, before, marking) {
            return harmless(classes, class, last);
        }
    }
    false
}

/// Whether a marking enables the same transitions as another one and has no more tokens anywhere.
fn smaller(markings: &Markings, before: u32, after: u32) -> bool {
    markings.enabled(before) == markings.enabled(after)
        && markings
            .tokens(before)
            .iter()
            .zip(markings.tokens(after))
            .all(|(before, after)| before <= after)
}

/// Whether no transition waits only for the tokens that the path from one class to the other adds.
fn harmless(classes: &Classes, from: ClassId, to: ClassId) -> bool {
    let rules = &classes.rules;
    let grows =
        |place: u32| classes.marking(from)[place as usize] < classes.marking(to)[place as usize];
    let waits = |marking: &[u32], transition: u32| {
        let mut lacks = rules
            .pt
            .needs
            .of(transition)
            .iter()
            .filter(|&&(place, need)| marking[place as usize] < need);
        let mut lacking = lacks.next().is_some_and(|&(place, _)| grows(place));
        lacking &= lacks.all(|&(place, _)| grows(place));
        lacking
    };
    let all = || 0..rules.pt.transitions.len() as u32;
    let mut class = to;
    while class != from {
        let (before, fired) = classes.parents[class as usize];
        let marking = classes.marking(before);
        let between = rules.between(marking, fired.0);
        if all().any(|it| waits(marking, it) || waits(&between, it)) {
            return false;
        }
        class = before;
    }
    true
}
