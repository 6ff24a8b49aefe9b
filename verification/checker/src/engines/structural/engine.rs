//! The engine that looks at the structure of a net.

use super::clauses::clauses;
use super::{Answer, Limit, Unknown, commoner, minimal_siphons_within};
use crate::bounds::bounds_within;
use crate::engines::{Bid, Budget, Engine, Extent, Finding, Found, Known, Reason, Task};
use crate::temporal::{Rest, Run};
use cotama_certificate::Evidence;
use cotama_property::{Atom, Formula, Linear};

/// Looks at the structure of the net and visits no marking.
#[derive(Clone, Copy, Debug)]
pub struct Structural;

impl Engine for Structural {
    fn name(&self) -> &'static str {
        "structural"
    }

    /// A marking never reached without intervals of time is never reached with them.
    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        match task {
            // The structure of a net with watches is not known, and its markings are.
            Task::Reach(_) if net.is_watched() && net.made().is_some() => None,
            Task::Reach(_) | Task::OneSafe => Some(Bid::new(Bid::STRUCTURE, budget)),
            _ if net.time().is_some() => None,
            Task::Bound(_) => Some(Bid::new(Bid::STRUCTURE, budget)),
            Task::Dead | Task::Live => Some(Bid::half(Bid::STRUCTURE, budget)),
            Task::Holds(..) | Task::Response(..) => None,
        }
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let found = match task {
            Task::Reach(Formula::Atom(Atom::Deadlock)) => deadlock(net, budget),
            Task::Reach(goal) => goal_by_clauses(net, goal, budget),
            Task::Bound(sum) => bound(net, sum, budget),
            Task::OneSafe => one_safe(net, &budget.with(budget.half())),
            Task::Dead => dead(net, budget),
            Task::Live => live(net, budget),
            Task::Holds(..) | Task::Response(..) => Found::Nothing(Reason::Unsuited),
        };
        // A path may not keep to the intervals.
        let is_way = matches!(found, Found::Path(_)) && net.time().is_some();
        Finding { found: if is_way { UNDECIDED } else { found }, states: 0 }
    }
}

const UNDECIDED: Found = Found::Nothing(Reason::Undecided);

/// There is no memory to look at the structure.
const NO_ROOM: Found = Found::Nothing(Reason::Limit(Limit::Bytes));

/// The most clauses that the structure is asked of where markings are stored.
const CLAUSES: usize = 8;

fn deadlock(net: &Known<'_>, budget: &Budget<'_>) -> Found {
    let Some(mut structure) = net.structure(budget) else { return NO_ROOM };
    match structure.deadlock() {
        Answer::Impossible(proof) => {
            let evidence = Evidence::deadlock_free(net.pt(), structure.dead(), &proof);
            Found::Never(evidence.unwrap_or(Evidence::None))
        }
        Answer::Reachable(path) => Found::Path(path),
        Answer::Unknown(why) => Found::Nothing(undecided(&why)),
    }
}

fn undecided(why: &Unknown) -> Reason {
    match why {
        Unknown::Limit(Limit::Time) => Reason::Limit(Limit::Time),
        _ => Reason::Undecided,
    }
}

fn goal_by_clauses(net: &Known<'_>, goal: &Formula, budget: &Budget<'_>) -> Found {
    let Some(clauses) = clauses(goal, net.pt()) else { return UNDECIDED };
    if net.made().is_some() && clauses.len() > CLAUSES {
        return Found::Nothing(Reason::Unsuited);
    }
    let Some(mut structure) = net.structure(budget) else { return NO_ROOM };
    let bounds: Vec<_> =
        structure.bounds().iter().map(|it| it.as_ref().map(|it| it.at_most)).collect();
    let mut undecided = false;
    let mut parts = Vec::new();
    for clause in &clauses {
        if !undecided || clause.iter().all(|it| possible(it, &bounds)) {
            match structure.reach(clause) {
                Answer::Impossible(proof) => parts.push((clause.clone(), proof)),
                Answer::Reachable(path) => return Found::Path(path),
                Answer::Unknown(Unknown::Limit(Limit::Time)) => {
                    return Found::Nothing(Reason::Limit(Limit::Time));
                }
                Answer::Unknown(_) => undecided = true,
            }
        }
    }
    if undecided {
        return UNDECIDED;
    }
    let evidence = Evidence::never(net.pt(), structure.dead(), goal, &parts);
    Found::Never(evidence.unwrap_or(Evidence::None))
}

/// Whether a marking within the bounds of single places can satisfy an inequality.
fn possible(linear: &Linear, bounds: &[Option<i64>]) -> bool {
    let least =
        linear.weights.iter().try_fold(i128::from(linear.constant), |sum, &(place, weight)| {
            let tokens =
                if weight > 0 { 0 } else { bounds.get(place.0 as usize).copied().flatten()? };
            Some(sum + i128::from(weight) * i128::from(tokens))
        });
    least.is_none_or(|it| it <= 0)
}

fn bound(net: &Known<'_>, sum: &Linear, budget: &Budget<'_>) -> Found {
    let Some(mut structure) = net.structure(budget) else { return NO_ROOM };
    let bound = structure.upper_bound(&sum.weights);
    let full = bound
        .as_ref()
        .and_then(|bound| Linear { constant: 0, ..sum.clone() }.at_least(bound.at_most));
    match (bound, full.map(|it| structure.reach(&[it]))) {
        (Some(bound), Some(Answer::Reachable(path))) => {
            let most = i128::from(bound.at_most) + i128::from(sum.constant);
            let fire: Vec<u32> = path.iter().map(|it| it.0).collect();
            let evidence = Evidence::bounded(net.pt(), structure.dead(), &bound)
                .map_or(Evidence::None, |it| Evidence::most(it, net.pt(), &fire));
            Found::Most(Extent::of(most), Some(path), evidence)
        }
        _ => UNDECIDED,
    }
}

/// The structure gives evidence with its answer; sums of places are sooner found.
fn one_safe(net: &Known<'_>, budget: &Budget<'_>) -> Found {
    if let Some(mut structure) = net.structure(budget)
        && let Answer::Impossible(bounds) = structure.one_safe()
    {
        let evidence = Evidence::one_safe(net.pt(), structure.dead(), &bounds);
        return Found::Never(evidence.unwrap_or(Evidence::None));
    }
    let is_one = |it: &Option<u32>| it.is_some_and(|it| it <= 1);
    let bounds = bounds_within(net.pt(), &budget.limits);
    let is_safe = bounds.is_ok_and(|it| it.iter().all(is_one));
    if is_safe { Found::Never(Evidence::None) } else { UNDECIDED }
}

fn dead(net: &Known<'_>, budget: &Budget<'_>) -> Found {
    let Some(mut structure) = net.structure(budget) else { return NO_ROOM };
    structure.find_dead_transitions();
    Found::SomeDead(structure.dead().transitions.clone())
}

/// Siphons that are looked for.
const SIPHONS: usize = 10_000;

/// A transition that never fires, a deadlock that the structure shows, or the theorem of Commoner.
fn live(net: &Known<'_>, budget: &Budget<'_>) -> Found {
    let pt = net.pt();
    if pt.transitions.is_empty() {
        return UNDECIDED;
    }
    match dead(net, budget) {
        Found::SomeDead(dead) if dead.is_empty() => {}
        Found::SomeDead(_) => return Found::Holds(false, None, Evidence::None),
        nothing => return nothing,
    }
    if let Found::Path(stem) = deadlock(net, budget) {
        return Found::Holds(false, Some(Run { stem, rest: Rest::Stays }), Evidence::None);
    }
    let siphons = minimal_siphons_within(pt, SIPHONS, &budget.limits);
    commoner(pt, &siphons).live.map_or(UNDECIDED, |it| Found::Holds(it, None, Evidence::None))
}
