//! A question to a smaller net.

use crate::engines::{Found, Reason, Task};
use crate::explicit;
use crate::reductions::{Effort, Goal, Keep, LiftError, Reduced, Tokens, Trail, reduce_within};
use crate::temporal::{Rest, Run};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;
use cotama_property::{Atom, Formula, Linear};

/// A smaller net, and what is asked of it.
pub(super) struct Smaller {
    pub(super) reduced: Reduced,
    /// The formula of the question; true where it is about a sum.
    pub(super) goal: Formula,
    /// The sum of the question; nothing where it is about a formula.
    pub(super) sum: Linear,
}

impl Smaller {
    /// For a task; `None` when the net does not become smaller.
    pub(super) fn new(pt: &Pt, task: Task<'_>, limits: &explicit::Limits) -> Option<Self> {
        match task {
            Task::Reach(goal) => Self::for_goal(pt, goal, limits),
            Task::Holds(formula, assumed) if assumed.is_empty() => {
                Self::for_formula(pt, formula, limits)
            }
            Task::Bound(sum) => Self::for_sum(pt, sum, limits),
            _ => None,
        }
    }

    /// The same task on the smaller net.
    pub(super) fn task<'t>(&'t self, task: Task<'t>) -> Task<'t> {
        match task {
            Task::Reach(_) => Task::Reach(&self.goal),
            Task::Holds(_, assumed) => Task::Holds(&self.goal, assumed),
            Task::Bound(_) => Task::Bound(&self.sum),
            task => task,
        }
    }

    /// The path of the original net.
    pub(super) fn path(&self, pt: &Pt, way: &[TransitionId]) -> Found {
        match self.reduced.trail.lift(pt, way) {
            Ok(way) => Found::Path(way),
            Err(LiftError::TooLong) => Found::Reached,
            Err(LiftError::NotARun) => Found::Nothing(Reason::Undecided),
        }
    }

    /// For a formula that is looked for in a marking; `None` when the net does not become smaller.
    fn for_goal(pt: &Pt, goal: &Formula, limits: &explicit::Limits) -> Option<Self> {
        match goal {
            Formula::Atom(Atom::Deadlock) => Self::formula(pt, goal, Goal::Deadlock, limits),
            _ if goal.any(&|it| matches!(it, Formula::Atom(Atom::Deadlock))) => None,
            _ => Self::formula(pt, goal, Goal::Reachability, limits),
        }
    }

    /// For a formula about runs.
    fn for_formula(pt: &Pt, formula: &Formula, limits: &explicit::Limits) -> Option<Self> {
        let deadlock = formula.any(&|it| matches!(it, Formula::Atom(Atom::Deadlock)));
        let steps = formula.any(&|it| matches!(it, Formula::Next(_)));
        let quantifiers = |it: &Formula| matches!(it, Formula::All(_) | Formula::Exists(_));
        match formula {
            Formula::All(path) | Formula::Exists(path)
                if !steps && !deadlock && !path.any(&quantifiers) =>
            {
                Self::formula(pt, formula, Goal::StutterInvariantLtl, limits)
            }
            _ => Self::formula(pt, formula, Goal::Ctl, limits),
        }
    }

    fn formula(pt: &Pt, formula: &Formula, goal: Goal, limits: &explicit::Limits) -> Option<Self> {
        let formula = in_tokens(formula, pt)?;
        let keep = Keep { places: visible(&formula), ..Keep::new(goal) };
        let reduced = smaller(pt, &keep, limits)?;
        let goal = rewritten(&formula, &reduced.trail)?.simplified();
        Some(Self { reduced, goal, sum: Linear::default() })
    }

    /// For a sum of tokens.
    fn for_sum(pt: &Pt, sum: &Linear, limits: &explicit::Limits) -> Option<Self> {
        let places = sum.weights.iter().map(|it| it.0).collect();
        let reduced = smaller(pt, &Keep { places, ..Keep::new(Goal::Bounds) }, limits)?;
        let sum = told(sum, &reduced.trail)?;
        Some(Self { reduced, goal: Formula::TRUE, sum })
    }

    /// The run of the original net; `None` when it cannot be told.
    pub(super) fn lifted(&self, pt: &Pt, run: Run) -> Option<Run> {
        let trail = &self.reduced.trail;
        match run.rest {
            Rest::Cycle(cycle) => {
                let (stem, cycle) = trail.lift_lasso(pt, &run.stem, &cycle).ok()?;
                Some(Run { stem, rest: Rest::Cycle(cycle) })
            }
            rest => Some(Run { stem: trail.lift(pt, &run.stem).ok()?, rest }),
        }
    }
}

/// Bytes of a place, transition or arc while a net is reduced.
const BYTES: u64 = 200;

/// A smaller net, if there is memory to make it.
fn smaller(pt: &Pt, keep: &Keep, limits: &explicit::Limits) -> Option<Reduced> {
    let size = (pt.places.len() + pt.transitions.len() + pt.arcs) as u64;
    if size * BYTES > limits.bytes || limits.is_over() {
        return None;
    }
    let reduced = reduce_within(pt, keep, limits, &Effort::default());
    (!reduced.counts.is_empty()).then_some(reduced)
}

/// The most inequalities that enabled transitions are written out to.
const MOST: usize = 20_000;

/// The same formula with tokens instead of transitions that are enabled.
fn in_tokens(formula: &Formula, pt: &Pt) -> Option<Formula> {
    let mut left = MOST;
    let mut enabled = |it: u32| {
        let needs = pt.needs.of(it);
        left = left.checked_sub(needs.len() + 1)?;
        let needs = needs.iter().map(|&(place, need)| {
            Formula::Atom(Atom::AtMost(Linear {
                constant: need.into(),
                weights: vec![(PlaceId(place), -1)],
            }))
        });
        Some(Formula::And(needs.collect()))
    };
    formula.with_atoms(&mut |atom| match atom {
        Atom::Fireable(transitions) => {
            Some(Formula::Or(transitions.iter().map(|it| enabled(it.0)).collect::<Option<_>>()?))
        }
        _ => Some(Formula::Atom(atom.clone())),
    })
}

fn visible(formula: &Formula) -> Vec<PlaceId> {
    let mut places = Vec::new();
    formula.with_atoms(&mut |atom| {
        if let Atom::AtMost(linear) = atom {
            places.extend(linear.weights.iter().map(|it| it.0));
        }
        Some(Formula::TRUE)
    });
    places.sort_unstable();
    places.dedup();
    places
}

/// The same formula in the tokens of the smaller net.
fn rewritten(formula: &Formula, trail: &Trail) -> Option<Formula> {
    formula.with_atoms(&mut |atom| match atom {
        Atom::AtMost(linear) => Some(Formula::Atom(Atom::AtMost(told(linear, trail)?))),
        Atom::Deadlock => Some(Formula::Atom(Atom::Deadlock)),
        Atom::Fireable(_) => None,
    })
}

fn told(linear: &Linear, trail: &Trail) -> Option<Linear> {
    let sum = Tokens { constant: linear.constant, weights: linear.weights.clone() };
    let Tokens { constant, weights } = trail.tokens(&sum)?;
    Some(Linear { constant, weights })
}
