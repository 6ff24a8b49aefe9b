//! The engines behind the trait.

use super::budget::Budget;
use super::clauses::clauses;
use super::engine::{Engine, Extent, Finding, Found, Reason, Task};
use super::known::Known;
use crate::certificate::Evidence;
use crate::coverability::{self, Bounded, CoverabilitySet, Coverable};
use crate::explicit::{self, Goal, Limit, Reached, reach};
use crate::property::{Assumptions, Atom, Ctl, Formula, Linear};
use crate::pt::Pt;
use crate::structural;
use crate::stubborn;
use crate::temporal::{self, Fairness, Verdict};
use cotama_core::net::{PlaceId, TransitionId};

/// Looks at the structure of the net and visits no marking.
#[derive(Clone, Copy, Debug)]
pub struct Structural;

impl Engine for Structural {
    fn name(&self) -> &'static str {
        "structural"
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let found = match task {
            Task::Reach(Formula::Atom(Atom::Deadlock)) => deadlock(net, budget),
            Task::Reach(goal) => goal_by_clauses(net, goal, budget),
            Task::Bound(sum) => bound(net, sum, budget),
            Task::Dead | Task::Live | Task::Temporal(_) | Task::Fair(..) => {
                Found::Nothing(Reason::Unsuited)
            }
        };
        Finding { found, states: 0 }
    }
}

fn deadlock(net: &Known<'_>, budget: &Budget<'_>) -> Found {
    let Some(mut structure) = net.structure(budget) else { return NO_ROOM };
    match structure.deadlock() {
        structural::Answer::Impossible(proof) => {
            let evidence = Evidence::deadlock_free(net.pt(), structure.dead(), &proof);
            Found::Never(evidence.unwrap_or(Evidence::None))
        }
        structural::Answer::Reachable(way) => Found::Way(way),
        structural::Answer::Unknown(why) => Found::Nothing(undecided(&why)),
    }
}

/// There is no memory to look at the structure.
const NO_ROOM: Found = Found::Nothing(Reason::Limit(Limit::Bytes));

fn undecided(why: &structural::Unknown) -> Reason {
    match why {
        structural::Unknown::Limit(structural::Stop::Time) => Reason::Limit(Limit::Time),
        _ => Reason::Undecided,
    }
}

fn goal_by_clauses(net: &Known<'_>, goal: &Formula, budget: &Budget<'_>) -> Found {
    let Some(clauses) = clauses(goal, net.pt()) else { return Found::Nothing(Reason::Undecided) };
    let Some(mut structure) = net.structure(budget) else { return NO_ROOM };
    let bounds: Vec<_> =
        structure.bounds().iter().map(|it| it.as_ref().map(|it| it.at_most)).collect();
    let mut undecided = false;
    let mut parts = Vec::new();
    for clause in &clauses {
        if !undecided || clause.iter().all(|it| possible(it, &bounds)) {
            match structure.reach(clause) {
                structural::Answer::Impossible(proof) => parts.push((clause.clone(), proof)),
                structural::Answer::Reachable(way) => return Found::Way(way),
                structural::Answer::Unknown(structural::Unknown::Limit(structural::Stop::Time)) => {
                    return Found::Nothing(Reason::Limit(Limit::Time));
                }
                structural::Answer::Unknown(_) => undecided = true,
            }
        }
    }
    if undecided {
        return Found::Nothing(Reason::Undecided);
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
        .and_then(|bound| above(&Linear { constant: 0, ..sum.clone() }, bound.at_most));
    match (bound, full.map(|it| structure.reach(&[it]))) {
        (Some(bound), Some(structural::Answer::Reachable(way))) => {
            let most = i128::from(bound.at_most) + i128::from(sum.constant);
            let fire: Vec<u32> = way.iter().map(|it| it.0).collect();
            let evidence = Evidence::bounded(net.pt(), structure.dead(), &bound)
                .map_or(Evidence::None, |it| Evidence::most(it, net.pt(), &fire));
            Found::Most(extent(most), Some(way), evidence)
        }
        _ => Found::Nothing(Reason::Undecided),
    }
}

/// `sum >= least` as an inequality.
fn above(sum: &Linear, least: i64) -> Option<Linear> {
    let weights = sum.weights.iter().map(|&(place, weight)| Some((place, weight.checked_neg()?)));
    let constant = least.checked_sub(sum.constant)?;
    Some(Linear { constant, weights: weights.collect::<Option<_>>()? })
}

fn extent(tokens: i128) -> Extent {
    Extent::Finite(u64::try_from(tokens.max(0)).unwrap_or(u64::MAX))
}

/// Meets all reachable markings, one by one, breadth first.
#[derive(Clone, Copy, Debug)]
pub struct Explicit;

impl Engine for Explicit {
    fn name(&self) -> &'static str {
        "explicit"
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        match task {
            Task::Reach(goal) => match Goal::new(goal) {
                Some(it) => {
                    reached(reach(net.pt(), it, &budget.limits, budget.jobs, budget.progress))
                }
                None => Finding::nothing(Reason::Unsuited, 0),
            },
            Task::Bound(sum) => most(net, sum, budget),
            Task::Dead => {
                let space = net.space(budget);
                let found = match space.limit {
                    Some(limit) => Found::Nothing(Reason::Limit(limit)),
                    None => Found::Dead(space.dead_transitions.clone(), Evidence::None),
                };
                Finding { found, states: space.states }
            }
            Task::Live => match net.graph(budget) {
                Ok(graph) => {
                    let found = Found::Holds(graph.liveness().is_live(), None, Evidence::None);
                    Finding { found, states: graph.states() as u64 }
                }
                Err(it) => Finding::nothing(Reason::Limit(it.limit), it.states),
            },
            Task::Temporal(_) | Task::Fair(..) => Finding::nothing(Reason::Unsuited, 0),
        }
    }
}

fn reached(reached: Reached) -> Finding {
    let states = reached.states();
    let found = match reached {
        Reached::Trace { transitions, .. } => Found::Way(transitions),
        Reached::Never { .. } => Found::Never(Evidence::None),
        Reached::Unknown { limit, .. } => Found::Nothing(Reason::Limit(limit)),
    };
    Finding { found, states }
}

/// The most of a sum.
fn most(net: &Known<'_>, sum: &Linear, budget: &Budget<'_>) -> Finding {
    if let (&[(place, 1)], 0) = (&sum.weights[..], sum.constant) {
        let space = net.space(budget);
        let found = match (space.limit, space.bounds.get(place.0 as usize)) {
            (None, Some(&tokens)) => Found::Most(Extent::Finite(tokens), None, Evidence::None),
            (limit, _) => Found::Nothing(limit.map_or(Reason::Undecided, Reason::Limit)),
        };
        return Finding { found, states: space.states };
    }
    let (limits, jobs) = (&budget.limits, budget.jobs);
    let (most, states) = match explicit::most(net.pt(), sum, limits, jobs, budget.progress) {
        Ok(found) => found,
        Err(it) => return Finding::nothing(Reason::Limit(it.limit), it.states),
    };
    // A way is a search of its own, which needs no longer than the first one.
    let goal = above(sum, most).map(|it| Formula::Atom(Atom::AtMost(it)));
    let asked = goal.as_ref().and_then(Goal::new);
    let way = asked.and_then(|it| match reach(net.pt(), it, limits, jobs, budget.progress) {
        Reached::Trace { transitions, .. } => Some(transitions),
        _ => None,
    });
    Finding { found: Found::Most(extent(most.into()), way, Evidence::None), states }
}

/// Meets markings best first, firing only some of the transitions in each.
#[derive(Clone, Copy, Debug)]
pub struct Stubborn;

impl Engine for Stubborn {
    fn name(&self) -> &'static str {
        "stubborn"
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let Task::Reach(goal) = task else { return Finding::nothing(Reason::Unsuited, 0) };
        let found = match goal {
            Formula::Atom(Atom::Deadlock) => {
                Some(stubborn::deadlock(net.pt(), &budget.limits, budget.progress))
            }
            _ => stubborn::reach_reduced(net.pt(), goal, &budget.limits, budget.progress),
        };
        found.map_or(Finding::nothing(Reason::Unsuited, 0), reached)
    }
}

/// Formulas of CTL and LTL.
#[derive(Clone, Copy, Debug)]
pub struct Temporal;

impl Engine for Temporal {
    fn name(&self) -> &'static str {
        "temporal"
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let formula = match task {
            Task::Temporal(formula) => formula,
            Task::Fair(formula, assumed) => return fair(net, formula, assumed, budget),
            _ => return Finding::nothing(Reason::Unsuited, 0),
        };
        let (graph, made) = (|| net.graph(budget), net.made());
        let limits = (&budget.limits, budget.jobs);
        let graphs: (temporal::Graphs<'_>, _) = (&graph, made.as_deref());
        found(temporal::answer_with(net.pt(), formula, limits, budget.progress, graphs))
    }
}

pub(super) fn found(verdict: Verdict) -> Finding {
    match verdict {
        Verdict::Known { holds, run, states } => {
            Finding { found: Found::Holds(holds, run, Evidence::None), states }
        }
        Verdict::Unknown { reason, states } => Finding::nothing(reason.into(), states),
    }
}

/// A formula as it is: what is the same on all runs need not be on fair ones, of which there may be
/// none.
fn fair(net: &Known<'_>, formula: &Formula, assumed: &Assumptions, budget: &Budget<'_>) -> Finding {
    let Some(fairness) = Fairness::of(assumed) else {
        return Finding::nothing(Reason::Unsuited, 0);
    };
    if Ctl::new(formula).is_none()
        && let Formula::All(path) | Formula::Exists(path) = formula
    {
        let all = matches!(formula, Formula::All(_));
        let asked = (&**path, assumed);
        return found(temporal::fair_runs(net.pt(), asked, all, &budget.limits, budget.progress));
    }
    match net.graph(budget) {
        Ok(graph) => {
            let bytes = budget.limits.bytes.saturating_sub(graph.bytes());
            found(temporal::branching(&*graph, formula, &fairness, bytes, budget.jobs))
        }
        Err(it) => Finding::nothing(Reason::Limit(it.limit), it.states),
    }
}

/// Nets with infinitely many markings: what more tokens keep true.
#[derive(Clone, Copy, Debug)]
pub struct Coverability;

impl Engine for Coverability {
    fn name(&self) -> &'static str {
        "coverability"
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let stop = || budget.limits.is_over();
        let limits = budget.coverability(&stop);
        let unfinished = |it: coverability::Unfinished| {
            Finding::nothing(Reason::Limit(limit(it.limit)), it.nodes)
        };
        match task {
            Task::Reach(goal) => match coverability::reaches(net.pt(), goal, &limits) {
                None => Finding::nothing(Reason::Unsuited, 0),
                Some(Coverable::Yes(way)) => match way.firings {
                    Some(way) => Finding { found: Found::Way(way), states: 0 },
                    None => Finding { found: Found::Reached, states: 0 },
                },
                Some(Coverable::No) => Finding { found: Found::Never(Evidence::None), states: 0 },
                Some(Coverable::Unknown(it)) => unfinished(it),
            },
            Task::Bound(_) | Task::Dead => match CoverabilitySet::new(net.pt(), &limits) {
                Ok(set) => Finding { found: covered(&set, task), states: set.met() },
                Err(it) => unfinished(it),
            },
            Task::Live | Task::Temporal(_) | Task::Fair(..) => {
                Finding::nothing(Reason::Unsuited, 0)
            }
        }
    }
}

/// Tokens of a marking on the way to which something is looked for that can be repeated.
const MANY: u64 = 50;

/// What can be repeated for ever and each time adds tokens to places: what first makes the net
/// unbounded, or else a part of the way to many tokens in one of them. There may be none: tokens
/// that grow in a place can be moved to another one.
pub(super) fn growth(pt: &Pt, places: &[PlaceId], budget: &Budget<'_>) -> Option<Evidence> {
    let stop = || budget.limits.is_over();
    let limits = budget.coverability(&stop);
    if let Bounded::No(growth) = coverability::bounded(pt, &limits)
        && growth.grows.iter().any(|it| places.contains(&it.0))
    {
        return Evidence::growth(pt, &growth);
    }
    let set = CoverabilitySet::new(pt, &limits).ok()?;
    places.iter().find_map(|&place| {
        let way = set.covers(&[(place, MANY)])?.firings.filter(|it| it.len() <= 2_000)?;
        let fired = |marking: &mut Vec<u32>, it: &TransitionId| {
            let after = pt.fire(marking, it.0)?;
            Some(std::mem::replace(marking, after))
        };
        let mut last = pt.initial.clone();
        let mut markings: Vec<Vec<u32>> = way.iter().map_while(|it| fired(&mut last, it)).collect();
        markings.push(last);
        let grows = |from: &[u32], to: &[u32]| {
            from[place.0 as usize] < to[place.0 as usize]
                && from.iter().zip(to).all(|(from, to)| from <= to)
        };
        let mut pairs = (0..markings.len()).flat_map(|to| (0..to).map(move |from| (from, to)));
        let (from, to) = pairs.find(|&(from, to)| grows(&markings[from], &markings[to]))?;
        let sequence = |it: &[TransitionId]| coverability::Sequence {
            length: it.len() as u128,
            firings: Some(it.into()),
        };
        let (stem, pump) = (sequence(&way[..from]), sequence(&way[from..to]));
        Evidence::growth(pt, &coverability::Growth { stem, pump, grows: Vec::new() })
    })
}

fn covered(set: &CoverabilitySet<'_>, task: Task<'_>) -> Found {
    let Task::Bound(sum) = task else { return Found::Dead(set.dead_transitions(), Evidence::None) };
    let mut places = Vec::new();
    for &(place, weight) in &sum.weights {
        match usize::try_from(weight) {
            Ok(times @ ..1_000) => places.extend(std::iter::repeat_n(place, times)),
            _ => return Found::Nothing(Reason::Undecided),
        }
    }
    match set.bound(&places) {
        None => Found::Most(Extent::Infinite, None, Evidence::None),
        Some(most) => match i128::try_from(most) {
            Ok(most) => Found::Most(extent(most + i128::from(sum.constant)), None, Evidence::None),
            Err(_) => Found::Nothing(Reason::Undecided),
        },
    }
}

fn limit(limit: coverability::Limit) -> Limit {
    match limit {
        coverability::Limit::Nodes => Limit::States,
        coverability::Limit::Bytes => Limit::Bytes,
        coverability::Limit::Stopped => Limit::Time,
        coverability::Limit::Numbers => Limit::Tokens,
    }
}
