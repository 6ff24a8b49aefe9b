//! The engine that meets all markings.

use super::{Goal, Graph, Reached, most, reach};
use crate::engines::{Bid, Budget, Engine, Extent, Finding, Found, Known, Reason, STORED, Task};
use cotama_certificate::{Evidence, most_markings};
use cotama_property::{Atom, Formula, Linear};

/// Meets all reachable markings, one by one, breadth first.
#[derive(Clone, Copy, Debug)]
pub struct Explicit;

/// The same, as long as there are few: before anything cleverer is tried.
#[derive(Clone, Copy, Debug)]
pub struct Few;

/// Looks at markings that are stored; stores them where evidence asks for it.
#[derive(Clone, Copy, Debug)]
pub struct Stored;

/// Markings that are few enough to be met before anything cleverer is tried.
const FEW: u64 = 600_000;

/// Markings of a net whose graph is evidence: those that the small checker passes through in less
/// than a minute.
const CERTIFIED: u64 = 500_000;

const NAME: &str = "explicit";

impl Engine for Explicit {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = match task {
            Task::Reach(_) | Task::Bound(_) | Task::Dead => !net.is_unbounded(),
            Task::Live => true,
            Task::OneSafe | Task::Holds(..) | Task::Response(..) => false,
        };
        (does && net.time().is_none()).then(|| Bid::new(Bid::ALL, budget))
    }

    fn knows_special(&self) -> bool {
        true
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        match task {
            Task::Reach(goal) => match Goal::new(goal) {
                Some(it) => {
                    reached(reach(net.pt(), it, &budget.limits, budget.jobs, budget.progress))
                }
                None => Finding::unsuited(),
            },
            Task::Bound(sum) => most_of(net, sum, budget),
            Task::Dead => {
                let space = net.space(budget);
                let found = match space.limit {
                    Some(limit) => Found::Nothing(Reason::Limit(limit)),
                    None => Found::Dead(space.dead_transitions.clone()),
                };
                Finding { found, states: space.states }
            }
            Task::Live => match net.graph(budget) {
                Ok(graph) => {
                    let found = Found::Holds(graph.liveness().is_live(), None, Evidence::None);
                    Finding { found, states: graph.states() as u64 }
                }
                Err(it) => Finding::stopped(it.limit, it.states),
            },
            Task::OneSafe | Task::Holds(..) | Task::Response(..) => Finding::unsuited(),
        }
    }
}

impl Engine for Few {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = matches!(task, Task::Reach(_)) && budget.limits.states > FEW;
        (does && net.time().is_none()).then(|| Bid::few(Bid::SEARCH, budget, FEW))
    }

    fn knows_special(&self) -> bool {
        true
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        Explicit.find(net, task, budget)
    }
}

impl Engine for Stored {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = matches!(task, Task::Reach(_)) && net.is_whole() && net.time().is_none();
        let made = net.made();
        // Stored markings take no more time, however many they are.
        let most = made.as_ref().map_or(STORED, |_| u64::MAX);
        let is_worth = budget.evidence || made.is_some();
        (does && is_worth).then(|| Bid::few(Bid::STORED, budget, most))
    }

    fn knows_special(&self) -> bool {
        true
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Task::Reach(goal) = task else { return Finding::unsuited() };
        if let Err(it) = net.graph(budget) {
            return Finding::stopped(it.limit, it.states);
        }
        // One that is too large to be kept would be made for each question anew.
        let Some(graph) = net.made() else { return Finding::undecided(0) };
        let found = match Goal::new(goal).and_then(|it| graph.first(it)) {
            Some(state) => Found::Path(graph.path(state)),
            None => Found::Never(evidence(net, &graph)),
        };
        Finding { found, states: graph.states() as u64 }
    }
}

/// The most markings that can be evidence of a net.
pub(crate) fn certified(net: &Known<'_>) -> u64 {
    CERTIFIED.min(most_markings(net.pt().places.len()))
}

/// All markings as evidence, if they are few enough for the small checker.
pub(crate) fn evidence(net: &Known<'_>, graph: &Graph) -> Evidence {
    if graph.states() as u64 <= certified(net) {
        Evidence::Graph(graph.states())
    } else {
        Evidence::None
    }
}

pub(crate) fn reached(reached: Reached) -> Finding {
    let states = reached.states();
    let found = match reached {
        Reached::Trace { transitions, .. } => Found::Path(transitions),
        Reached::Never { .. } => Found::Never(Evidence::None),
        Reached::Unknown { limit, .. } => Found::Nothing(Reason::Limit(limit)),
    };
    Finding { found, states }
}

/// The most of a sum.
fn most_of(net: &Known<'_>, sum: &Linear, budget: &Budget<'_>) -> Finding {
    if let (&[(place, 1)], 0) = (&sum.weights[..], sum.constant) {
        let space = net.space(budget);
        let found = match (space.limit, space.bounds.get(place.0 as usize)) {
            (None, Some(&tokens)) => Found::Most(Extent::Finite(tokens), None, Evidence::None),
            (limit, _) => Found::Nothing(limit.map_or(Reason::Undecided, Reason::Limit)),
        };
        return Finding { found, states: space.states };
    }
    let (limits, jobs) = (&budget.limits, budget.jobs);
    let (most, states) = match most(net.pt(), sum, limits, jobs, budget.progress) {
        Ok(found) => found,
        Err(it) => return Finding::stopped(it.limit, it.states),
    };
    // A path is a search of its own, which needs no longer than the first one.
    let goal = sum.at_least(most).map(|it| Formula::Atom(Atom::AtMost(it)));
    let asked = goal.as_ref().and_then(Goal::new);
    let path = asked.and_then(|it| match reach(net.pt(), it, limits, jobs, budget.progress) {
        Reached::Trace { transitions, .. } => Some(transitions),
        _ => None,
    });
    Finding { found: Found::Most(Extent::of(most.into()), path, Evidence::None), states }
}
