//! The engine of time nets.

use super::in_time::InTime;
use super::{ClassGraph, Classes, Limit, Limits, Reach, Response, Time, TimeNet};
use super::{deadlock, longest, measured, reach};
use crate::engines::{Bid, Budget, Engine, Extent, Finding, Found, Known, Task};
use crate::temporal::{Fairness, Successors, branching, of_runs, stored_runs, verdict};
use cotama_certificate::Evidence;
use cotama_core::net::TransitionId;
use cotama_property::{Assumptions, Atom, Condition, Ctl, Formula, Linear};
use std::rc::Rc;

/// State classes of a net whose transitions fire within intervals of time.
#[derive(Clone, Copy, Debug)]
pub struct StateClasses;

impl Engine for StateClasses {
    fn name(&self) -> &'static str {
        "classes"
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = net.time().is_some() && !matches!(task, Task::OneSafe);
        does.then(|| Bid::new(Bid::ALL, budget))
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Some(time) = net.time() else { return Finding::unsuited() };
        let asked = Asked { net, time, budget };
        let found = match task {
            Task::Reach(goal) => return asked.reach(goal),
            Task::Response(from, to) => {
                return response(measured(time, Some(from), to, &budget.limits));
            }
            Task::Holds(formula, assumed) => asked.holds(formula, assumed),
            Task::Bound(sum) => {
                asked.counted(|it| Found::Most(most(it, sum), None, Evidence::None))
            }
            Task::Dead => {
                let transitions = net.pt().transitions.len() as u32;
                asked.counted(|it| {
                    let fires = it.fired(transitions as usize);
                    let dead = (0..transitions).filter(|&it| !fires[it as usize]);
                    Found::Dead(dead.map(TransitionId).collect())
                })
            }
            Task::Live => net.atomic(time, &budget.limits).map(|graph| {
                let found = Found::Holds(graph.is_live(), None, Evidence::None);
                Finding { found, states: graph.states() as u64 }
            }),
            Task::OneSafe => Ok(Finding::unsuited()),
        };
        found.unwrap_or_else(stopped)
    }
}

/// A question to the classes of a net.
struct Asked<'a, 'n> {
    net: &'a Known<'n>,
    time: &'n TimeNet,
    budget: &'a Budget<'a>,
}

/// A finding, or what ended the work after how many classes.
type Result = std::result::Result<Finding, (Limit, usize)>;

impl Asked<'_, '_> {
    fn reach(&self, goal: &Formula) -> Finding {
        let reached = match goal {
            Formula::Atom(Atom::Deadlock) => deadlock(self.time, &self.budget.limits),
            goal => match Condition::new(goal, self.net.pt()) {
                Some(goal) => reach(self.time, |marking| goal.holds(marking), &self.budget.limits),
                None => return Finding::unsuited(),
            },
        };
        match reached {
            Reach::Reached(run) => {
                let way: Vec<_> = run.steps.iter().map(|it| it.transition).collect();
                Finding { states: way.len() as u64 + 1, found: Found::Path(way) }
            }
            Reach::Unreachable { classes } => {
                Finding { found: Found::Never(Evidence::None), states: classes as u64 }
            }
            Reach::Unknown { limit, classes } => stopped((limit, classes)),
        }
    }

    /// Returns an answer counted over all linear classes.
    fn counted(&self, found: impl FnOnce(&Classes) -> Found) -> Result {
        let classes = self.classes()?;
        Ok(Finding { found: found(&classes), states: classes.classes() as u64 })
    }

    fn classes(&self) -> std::result::Result<Rc<Classes>, (Limit, usize)> {
        self.net.classes(self.time, &self.budget.limits)
    }

    /// A formula about single runs by linear classes, which have the firing sequences of the net;
    /// one of CTL by atomic ones: all states of one go on in the same way.
    fn holds(&self, formula: &Formula, assumed: &Assumptions) -> Result {
        if let Some((path, all)) = of_runs(formula) {
            let classes = ClassGraph::from(&*self.classes()?);
            let (limits, jobs) = (self.left(&classes), self.budget.jobs);
            let asked = (path, assumed);
            let progress = self.budget.progress;
            return Ok(verdict(stored_runs(&classes, asked, all, (&limits, jobs), progress)));
        }
        if let Some(asked) = InTime::new(formula).filter(|_| assumed.is_empty()) {
            return self.responds(&asked);
        }
        let fairness = Fairness::of(assumed).filter(|_| Ctl::new(formula).is_some());
        let Some(fairness) = fairness else { return Ok(Finding::unsuited()) };
        let graph = self.net.atomic(self.time, &self.budget.limits)?;
        let (bytes, jobs) = (self.left(&graph).bytes, self.budget.jobs);
        Ok(verdict(branching(&*graph, formula, &fairness, bytes, jobs)))
    }

    /// Returns the limits that remain beside a graph.
    fn left(&self, graph: &ClassGraph) -> Limits {
        let limits = self.budget.limits;
        Limits { bytes: limits.bytes.saturating_sub(graph.bytes()), ..limits }
    }

    fn responds(&self, asked: &InTime) -> Result {
        let pt = self.net.pt();
        let conditions = Condition::new(&asked.cause, pt).zip(Condition::new(&asked.effect, pt));
        let Some((cause, effect)) = conditions else { return Ok(Finding::unsuited()) };
        let classes = self.classes()?;
        let states = classes.classes();
        let [cause, effect] = [cause, effect].map(|it| move |at: &[u32]| it.holds(at));
        let most = longest(&classes, cause, effect, asked.at_start, &self.budget.limits)
            .map_err(|limit| (limit, states))?;
        let found = Found::Holds(most <= Time::Finite(asked.limit), None, Evidence::None);
        Ok(Finding { found, states: states as u64 })
    }
}

/// The most that a sum is in some class.
fn most(classes: &Classes, sum: &Linear) -> Extent {
    let of = |class| {
        let tokens = |place: usize| i128::from(classes.marking(class)[place]);
        let parts = sum.weights.iter().map(|&(it, by)| i128::from(by) * tokens(it.0 as usize));
        i128::from(sum.constant) + parts.sum::<i128>()
    };
    Extent::of((0..classes.classes() as u32).map(of).max().unwrap_or(0))
}

/// An answer of so many classes.
fn response((response, classes): (Response, usize)) -> Finding {
    let found = match response {
        Response::NeverFires => Found::Response(None),
        Response::Between { min, max } => Found::Response(Some((min, max))),
        Response::Unknown { limit, .. } => return stopped((limit, classes)),
    };
    Finding { found, states: classes as u64 }
}

/// Classes that are not all known.
fn stopped((limit, classes): (Limit, usize)) -> Finding {
    Finding::stopped(limit, classes as u64)
}
