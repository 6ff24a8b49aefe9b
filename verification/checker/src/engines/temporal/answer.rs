//! One answer to a formula, by the engine that suits it.

use super::ctl::ctl;
use super::fairness::Fairness;
use super::ltl::{all_runs, some_runs};
use super::successors::Successors;
use super::verdict::{Reason, Verdict};
use super::witness::Witness;
use crate::explicit::{Graph, Limits, Progress, Reached};
use crate::stubborn::reach_reduced;
use cotama_property::pt::Pt;
use cotama_property::run::{Rest, Run};
use cotama_property::{Condition, Ctl, Formula, Reachability};

/// Whether a formula holds in the initial marking.
///
/// `EF` and `AG` of one marking are answered by [`reach_reduced`], other quantifiers before a
/// formula without quantifiers by [`all_runs`] and [`some_runs`], and what is left, if it is of
/// CTL, by [`ctl`](super::ctl()) on the stored graph. Parts of formulas are asked one by one by
/// [`check`](mod@crate::check).
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::explicit::Limits;
/// use cotama_verification::property::{Question, parse};
/// use cotama_verification::pt::Pt;
/// use cotama_verification::temporal::{Verdict, answer};
///
/// let mut fuse = OwnedNet::new("fuse", "A fuse that blows.");
/// let whole = fuse.place(OwnedPlace::new("whole", 1)).unwrap();
/// fuse.transition(OwnedTransition::new("blow").take(whole, 1)).unwrap();
/// let fuse = Pt::from(&fuse.view().net());
/// let Question::Formula(formula) = parse("AF deadlock & EX !whole", &fuse).unwrap().question
/// else {
///     panic!("not a formula")
/// };
/// let verdict = answer(&fuse, &formula, &Limits::default(), &|_| ());
/// assert!(matches!(verdict, Verdict::Known { holds: true, .. }));
/// ```
pub fn answer(pt: &Pt, formula: &Formula, limits: &Limits, progress: &dyn Fn(Progress)) -> Verdict {
    let formula = formula.simplified();
    if let Some(condition) = Condition::new(&formula, pt) {
        let holds = condition.holds(pt.initial.as_slice());
        return Verdict::Known { holds, run: None, states: 1 };
    }
    if let Some(asked) = Reachability::new(&formula)
        && let Some(reached) = reach_reduced(pt, &asked.goal, limits, progress)
    {
        return match reached {
            Reached::Trace { transitions, states } => {
                let run = Some(Run { stem: transitions, rest: Rest::Any });
                Verdict::Known { holds: asked.expected, run, states }
            }
            Reached::Never { states } => {
                Verdict::Known { holds: !asked.expected, run: None, states }
            }
            Reached::Unknown { limit, states } => Verdict::Unknown { reason: limit.into(), states },
        };
    }
    match &formula {
        Formula::All(path) if is_of_runs(path) => all_runs(pt, path, limits, progress),
        Formula::Exists(path) if is_of_runs(path) => some_runs(pt, path, limits, progress),
        formula if Ctl::new(formula).is_none() => {
            Verdict::Unknown { reason: Reason::Kind, states: 0 }
        }
        formula => match Graph::new(pt, limits, progress) {
            Ok(graph) => {
                let bytes = limits.bytes.saturating_sub(graph.bytes());
                branching(&graph, formula, &Fairness::default(), bytes, 1)
            }
            Err(it) => Verdict::Unknown { reason: it.limit.into(), states: it.states },
        },
    }
}

/// The verdict on a formula of CTL, with so many bytes beside the graph.
pub(crate) fn branching(
    graph: &impl Successors,
    formula: &Formula,
    fairness: &Fairness<'_>,
    bytes: u64,
    jobs: usize,
) -> Verdict {
    let states = graph.states() as u64;
    let Some(form) = Ctl::new(formula) else {
        return Verdict::Unknown { reason: Reason::Kind, states: 0 };
    };
    match ctl(graph, &form, fairness, bytes, jobs) {
        Ok(answer) => {
            let shows =
                |it: &Witness| it.is_complete || (fairness.is_none() && can_be_lost(formula));
            let run = answer.witness.filter(shows).map(|it| it.run);
            Verdict::Known { holds: answer.verdict, run, states }
        }
        Err(limit) => Verdict::Unknown { reason: limit.into(), states },
    }
}

/// `AG EF p`: that it does not hold is shown by a run to a marking from which no run reaches `p`,
/// although that run cannot show the latter.
fn can_be_lost(formula: &Formula) -> bool {
    let Formula::All(always) = formula else { return false };
    let Formula::Globally(inner) = &**always else { return false };
    let Formula::Exists(path) = &**inner else { return false };
    matches!(&**path, Formula::Finally(goal) if goal.is_state())
}

/// Whether a formula after a quantifier speaks of the whole run, and has no quantifiers: `EX` and
/// `AX` speak of successors.
pub(crate) fn is_of_runs(path: &Formula) -> bool {
    !matches!(path, Formula::Next(inner) if !inner.needs_run())
        && !path.any(&|it| matches!(it, Formula::Exists(_) | Formula::All(_) | Formula::Within(..)))
}
