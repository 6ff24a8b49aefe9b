//! One answer to a formula, by whichever engine suits it.

use super::ctl::ctl;
use super::fairness::Fairness;
use super::ltl::{all_runs, some_runs, stored_runs};
use super::run::{Rest, Run};
use super::successors::Successors;
use super::verdict::{Reason, Verdict};
use super::witness::Witness;
use crate::explicit::{Graph, Limits, Progress, Reached, Unfinished};
use crate::property::{Assumptions, Condition, Ctl, Formula, Reachability};
use crate::pt::Pt;
use crate::stubborn::reach_reduced;
use std::cell::OnceCell;
use std::sync::Arc;

/// Whether a formula holds in the initial marking.
///
/// `EF` and `AG` of one marking are answered by [`reach_reduced`], other quantifiers before a
/// formula without quantifiers by [`all_runs`] and [`some_runs`], and what is left, if it is of
/// CTL, by [`ctl`] on the stored graph. Of a conjunction or disjunction only as many parts are
/// answered as are needed.
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
    let made = OnceCell::new();
    let graph = || made.get_or_init(|| Graph::new(pt, limits, progress).map(Arc::new)).clone();
    answer_with(pt, formula, (limits, 1), progress, (&graph, None))
}

/// Gives the graph of the net, which is made when it is asked for first.
pub(crate) type Graphs<'a> = &'a dyn Fn() -> Result<Arc<Graph>, Unfinished>;

/// The same as [`answer`] with a graph that others use too, and all of it by that graph if it is
/// there already.
pub(crate) fn answer_with(
    pt: &Pt,
    formula: &Formula,
    (limits, jobs): (&Limits, usize),
    progress: &dyn Fn(Progress),
    (graph, made): (Graphs<'_>, Option<&Graph>),
) -> Verdict {
    Asked { pt, limits, jobs, progress, graph, made }.verdict(&formula.simplified())
}

struct Asked<'a> {
    pt: &'a Pt,
    limits: &'a Limits,
    jobs: usize,
    progress: &'a dyn Fn(Progress),
    graph: Graphs<'a>,
    made: Option<&'a Graph>,
}

impl Asked<'_> {
    fn verdict(&mut self, formula: &Formula) -> Verdict {
        if let Some(condition) = Condition::new(formula, self.pt) {
            let holds = condition.holds(self.pt.initial.as_slice());
            return Verdict::Known { holds, run: None, states: 1 };
        }
        if let Some(graph) = self.made
            && Ctl::new(formula).is_some()
        {
            return self.on(graph, formula);
        }
        if let Some(asked) = Reachability::new(formula)
            && let Some(reached) = reach_reduced(self.pt, &asked.goal, self.limits, self.progress)
        {
            return match reached {
                Reached::Trace { transitions, states } => {
                    let run = Some(Run { stem: transitions, rest: Rest::Any });
                    Verdict::Known { holds: asked.expected, run, states }
                }
                Reached::Never { states } => {
                    Verdict::Known { holds: !asked.expected, run: None, states }
                }
                Reached::Unknown { limit, states } => {
                    Verdict::Unknown { reason: limit.into(), states }
                }
            };
        }
        match formula {
            Formula::Not(inner) => match self.verdict(inner) {
                Verdict::Known { holds, run, states } => {
                    Verdict::Known { holds: !holds, run, states }
                }
                unknown @ Verdict::Unknown { .. } => unknown,
            },
            Formula::And(parts) => self.parts(parts, false),
            Formula::Or(parts) => self.parts(parts, true),
            Formula::All(path) | Formula::Exists(path) if is_of_runs(path) => {
                self.runs(path, matches!(formula, Formula::All(_)))
            }
            _ => self.branching(formula),
        }
    }

    fn runs(&self, path: &Formula, all: bool) -> Verdict {
        match self.made {
            Some(graph) => {
                let bytes = self.limits.bytes.saturating_sub(graph.bytes());
                let limits = Limits { bytes, ..*self.limits };
                let asked = (path, &Assumptions::default());
                stored_runs(graph, asked, all, (&limits, self.jobs), self.progress)
            }
            None if all => all_runs(self.pt, path, self.limits, self.progress),
            None => some_runs(self.pt, path, self.limits, self.progress),
        }
    }

    /// The verdict on parts one of which decides if it is `decisive`.
    fn parts(&mut self, parts: &[Formula], decisive: bool) -> Verdict {
        let (mut met, mut open) = (0, None);
        let mut shown = None;
        // What needs no graph first.
        let (hard, easy): (Vec<_>, Vec<_>) = parts.iter().partition(|it| needs_graph(it));
        for part in easy.into_iter().chain(hard) {
            match self.verdict(part) {
                Verdict::Known { holds, run, states } if holds == decisive => {
                    return Verdict::Known { holds, run, states: states.max(met) };
                }
                Verdict::Known { run, states, .. } => {
                    met = states.max(met);
                    shown = if parts.len() == 1 { run } else { None };
                }
                Verdict::Unknown { reason, states } => {
                    met = states.max(met);
                    open = open.or(Some(reason));
                }
            }
        }
        match open {
            Some(reason) => Verdict::Unknown { reason, states: met },
            None => Verdict::Known { holds: !decisive, run: shown, states: met },
        }
    }

    fn branching(&mut self, formula: &Formula) -> Verdict {
        if Ctl::new(formula).is_none() {
            return Verdict::Unknown { reason: Reason::Kind, states: 0 };
        }
        match (self.graph)() {
            Ok(graph) => self.on(&graph, formula),
            Err(it) => Verdict::Unknown { reason: it.limit.into(), states: it.states },
        }
    }

    fn on(&self, graph: &Graph, formula: &Formula) -> Verdict {
        let bytes = self.limits.bytes.saturating_sub(graph.bytes());
        branching(graph, formula, &Fairness::default(), bytes, self.jobs)
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

fn needs_graph(formula: &Formula) -> bool {
    match formula {
        Formula::Not(inner) => needs_graph(inner),
        Formula::And(all) | Formula::Or(all) => all.iter().any(needs_graph),
        Formula::All(path) | Formula::Exists(path) => !is_of_runs(path),
        _ => false,
    }
}
