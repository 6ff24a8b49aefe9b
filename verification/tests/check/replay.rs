//! Runs, fired step by step, and whether they show what they are said to show.

use crate::properties::oracle::{self, Space};
use cotama_core::net::TransitionId;
use cotama_verification::check::{Answer, Extent, Verdict};
use cotama_verification::property::{Atom, Formula, Question, Reachability};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Rest, Run};

/// The markings on the way, the initial one first.
pub(crate) fn markings(pt: &Pt, firings: &[TransitionId]) -> Vec<Vec<u32>> {
    let mut markings = vec![pt.initial.clone()];
    for (at, &TransitionId(it)) in firings.iter().enumerate() {
        let marking = markings.last().unwrap();
        assert!(pt.enabled(marking, it), "{}: firing {} is not enabled", pt.name, at + 1);
        markings.push(pt.fire(marking, it).unwrap());
    }
    markings
}

/// The markings of a run, and the position to which the last one leads back; `None` where it goes
/// on in any way.
pub(crate) fn walk(pt: &Pt, run: &Run) -> (Vec<Vec<u32>>, Option<usize>) {
    let back = run.stem.len();
    match &run.rest {
        Rest::Any => (markings(pt, &run.stem), None),
        Rest::Stays => {
            let markings = markings(pt, &run.stem);
            assert!(is_dead(pt, &markings[back]), "{}: the run could go on", pt.name);
            (markings, Some(back))
        }
        Rest::Cycle(cycle) => {
            assert!(!cycle.is_empty());
            let mut markings = markings(pt, &[&run.stem[..], cycle].concat());
            assert_eq!(
                markings.pop().as_ref(),
                Some(&markings[back]),
                "{}: the loop is open",
                pt.name
            );
            (markings, Some(back))
        }
    }
}

fn is_dead(pt: &Pt, marking: &[u32]) -> bool {
    (0..pt.transitions.len() as u32).all(|it| !pt.enabled(marking, it))
}

/// Replays the run of an answer, on a net of any size; when one marking decides, its last one has
/// to. Whether there is a run.
pub(crate) fn replays(pt: &Pt, question: &Question, answer: &Answer) -> bool {
    let Some(run) = &answer.run else { return false };
    let (markings, _) = walk(pt, run);
    let last = &markings[run.stem.len()];
    match (question, &answer.verdict) {
        (Question::Formula(formula), Verdict::Holds(holds)) => {
            if let Some(asked) = Reachability::new(&formula.simplified()) {
                assert_eq!(*holds, asked.expected);
                assert!(meets(pt, last, &asked.goal), "{}: {}", pt.name, question.display(pt));
            }
        }
        (Question::Fair(..), Verdict::Holds(_)) => {}
        (Question::Bound(places), Verdict::Bound(Extent::Finite(most))) => {
            let tokens: u64 = places.iter().map(|it| u64::from(last[it.0 as usize])).sum();
            assert_eq!(tokens, *most, "{}: {}", pt.name, question.display(pt));
        }
        (Question::OneSafe, Verdict::Holds(false)) => assert!(last.iter().any(|&it| it > 1)),
        (Question::Liveness, Verdict::Holds(false)) => assert!(is_dead(pt, last)),
        other => panic!("a run for {other:?}"),
    }
    true
}

pub(crate) fn meets(pt: &Pt, marking: &[u32], goal: &Formula) -> bool {
    match goal {
        Formula::Not(inner) => !meets(pt, marking, inner),
        Formula::And(parts) => parts.iter().all(|it| meets(pt, marking, it)),
        Formula::Or(parts) => parts.iter().any(|it| meets(pt, marking, it)),
        Formula::Atom(Atom::Deadlock) => is_dead(pt, marking),
        Formula::Atom(Atom::Fireable(all)) => all.iter().any(|it| pt.enabled(marking, it.0)),
        Formula::Atom(Atom::AtMost(linear)) => oracle::at_most(linear, marking),
        other => panic!("{other:?} is not about one marking"),
    }
}

/// Whether the run of an answer shows the verdict on a formula, by the book: the run itself is as
/// the formula says, or, where it speaks of all runs, is not. Of several formulas, one is shown.
pub(crate) fn shows(space: &Space<'_>, formula: &Formula, holds: bool, run: &Run) -> bool {
    let (pt, run) = (space.net, run.clone().closed(space.net));
    match (formula, holds) {
        (Formula::Not(inner), _) => shows(space, inner, !holds, &run),
        (Formula::And(parts), false) | (Formula::Or(parts), true) => {
            parts.iter().any(|it| shows(space, it, holds, &run))
        }
        (Formula::Exists(path), true) | (Formula::All(path), false) => {
            let (markings, back) = walk(pt, &run);
            let place =
                |it: &Vec<u32>| space.markings.iter().position(|other| it == other).unwrap();
            let run: Vec<usize> = markings.iter().map(place).collect();
            oracle::lasso(space, &run, back.expect("a run that is closed"), path) == holds
        }
        // No run shows it.
        _ => false,
    }
}
