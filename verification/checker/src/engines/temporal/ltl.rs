//! Formulas of LTL.

use super::emptiness::{Searched, some_run};
use super::source::{Met, Stored};
use super::stop::Stop;
use super::successors::Successors;
use super::verdict::{Reason, Verdict};
use crate::explicit::{Limits, Progress};
use cotama_property::pt::Pt;
use cotama_property::{Assumptions, Formula, Ltl};

/// Whether a formula without quantifiers is true of all runs from the initial marking. A
/// counterexample is a lasso, short but not always a shortest one. `progress` is called now and
/// then.
///
/// Of a formula without `X`, in each marking only some transitions are fired where the others make
/// no difference.
///
/// ```
/// use cotama_core::net::TransitionId;
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::explicit::Limits;
/// use cotama_verification::property::{Formula, Question, parse};
/// use cotama_verification::pt::Pt;
/// use cotama_verification::temporal::{Rest, Run, Verdict, all_runs};
///
/// let mut lamp = OwnedNet::new("lamp", "A lamp that may fail.");
/// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
/// lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// lamp.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
/// lamp.transition(OwnedTransition::new("fail").take(on, 1)).unwrap();
/// let lamp = Pt::from(&lamp.view().net());
/// let path = |text: &str| match parse(text, &lamp).unwrap().question {
///     Question::Formula(Formula::All(path)) => *path,
///     _ => panic!("not A"),
/// };
/// let verdict = all_runs(&lamp, &path("A (F on)"), &Limits::default(), &|_| ());
/// assert!(matches!(verdict, Verdict::Known { holds: true, .. }));
/// let verdict = all_runs(&lamp, &path("A (G F off)"), &Limits::default(), &|_| ());
/// let Verdict::Known { holds: false, run: Some(run), .. } = verdict else { panic!("it holds") };
/// assert_eq!(run, Run { stem: vec![TransitionId(0), TransitionId(2)], rest: Rest::Stays });
/// ```
pub fn all_runs(pt: &Pt, path: &Formula, limits: &Limits, progress: &dyn Fn(Progress)) -> Verdict {
    met(pt, Ltl::negation_of(path), false, limits, progress)
}

/// Whether a formula without quantifiers is true of some run from the initial marking; the answer
/// is as that of [`all_runs`].
///
/// ```
/// use cotama_verification::explicit::Limits;
/// use cotama_verification::property::{self, Formula, Question};
/// use cotama_verification::temporal::{Verdict, some_runs};
/// use cotama_verification::tina;
/// let net = b"tr on off -> lit  tr fade lit -> off  tr break lit -> out  pl off (1)";
/// let lamp = tina::read("lamp.net", net).unwrap().untimed();
/// let asked = property::parse("E (G F lit)", &lamp).unwrap();
/// let Question::Formula(Formula::Exists(path)) = asked.question else { panic!("no run") };
/// let verdict = some_runs(&lamp, &path, &Limits::default(), &|_| {});
/// assert!(matches!(verdict, Verdict::Known { holds: true, .. })); // if it never breaks
/// ```
pub fn some_runs(pt: &Pt, path: &Formula, limits: &Limits, progress: &dyn Fn(Progress)) -> Verdict {
    met(pt, Ltl::new(path), true, limits, progress)
}

/// Whether a formula without quantifiers is true of all, or of some, of the runs of a net that are
/// as assumed.
pub(crate) fn fair_runs(
    pt: &Pt,
    (path, assumed): (&Formula, &Assumptions),
    all: bool,
    limits: &Limits,
    progress: &dyn Fn(Progress),
) -> Verdict {
    met(pt, Ltl::fair(path, assumed, !all), !all, limits, progress)
}

/// The same of the runs of a graph in which a transition leads to one state at most; the bytes of
/// the graph itself are not counted.
pub(crate) fn stored_runs(
    graph: &impl Successors,
    (path, assumed): (&Formula, &Assumptions),
    all: bool,
    (limits, jobs): (&Limits, usize),
    progress: &dyn Fn(Progress),
) -> Verdict {
    known(Ltl::fair(path, assumed, !all), !all, |formula| {
        some_run(Stored::new(graph, formula, limits, jobs), formula, progress)
    })
}

fn met(
    pt: &Pt,
    formula: Option<Ltl>,
    found: bool,
    limits: &Limits,
    progress: &dyn Fn(Progress),
) -> Verdict {
    known(formula, found, |formula| some_run(Met::new(pt, formula, limits), formula, progress))
}

/// The verdict on a formula of which finding a run says `found`.
fn known(formula: Option<Ltl>, found: bool, search: impl FnOnce(&Ltl) -> Searched) -> Verdict {
    let Some(formula) = formula else {
        return Verdict::Unknown { reason: Reason::Kind, states: 0 };
    };
    let searched = search(&formula);
    let states = searched.states;
    match searched.run {
        Ok(run) => Verdict::Known { holds: run.is_some() == found, run, states },
        Err(Stop::Limit(limit)) => Verdict::Unknown { reason: limit.into(), states },
        Err(Stop::TooLarge) => Verdict::Unknown { reason: Reason::Formula, states },
    }
}
