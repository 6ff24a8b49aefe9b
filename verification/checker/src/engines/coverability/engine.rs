//! The engine for nets with infinitely many markings.

use super::{Bounded, CoverabilitySet, Coverable, Unfinished, bounded, reaches};
use crate::bounds::bounds_within;
use crate::engines::{Bid, Budget, Engine, Extent, Finding, Found, Known, Reason, Task};
use cotama_certificate::Evidence;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;

/// Nets with infinitely many markings: what more tokens keep true.
#[derive(Clone, Copy, Debug)]
pub struct Coverability;

/// The same, as long as there are few ω-markings: of a net that no sum of places bounds, these may
/// tell how many tokens there are before all markings are met.
#[derive(Clone, Copy, Debug)]
pub struct FewOmegas;

const OMEGAS: u64 = 2_000;

const NAME: &str = "coverability";

impl Engine for Coverability {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let bid = match task {
            Task::Reach(_) => Bid::half(Bid::SEARCH, budget),
            Task::Bound(_) | Task::Dead => Bid::new(Bid::ALL, budget),
            Task::OneSafe | Task::Live | Task::Holds(..) | Task::Response(..) => return None,
        };
        (net.is_unbounded() && net.time().is_none()).then_some(bid)
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let limits = budget.coverability();
        let unfinished = |it: Unfinished| Finding::stopped(it.limit, it.nodes);
        match task {
            Task::Reach(goal) => match reaches(net.pt(), goal, &limits) {
                None => Finding::unsuited(),
                Some(Coverable::Yes(path)) => match path.firings {
                    Some(path) => Finding { found: Found::Path(path), states: 0 },
                    None => Finding { found: Found::Reached, states: 0 },
                },
                Some(Coverable::No) => Finding { found: Found::Never(Evidence::None), states: 0 },
                Some(Coverable::Unknown(it)) => unfinished(it),
            },
            Task::Bound(_) | Task::Dead => match CoverabilitySet::new(net.pt(), &limits) {
                Ok(set) => Finding { found: covered(&set, task), states: set.met() },
                Err(it) => unfinished(it),
            },
            Task::OneSafe | Task::Live | Task::Holds(..) | Task::Response(..) => {
                Finding::unsuited()
            }
        }
    }
}

impl Engine for FewOmegas {
    fn name(&self) -> &'static str {
        NAME
    }

    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
        let does = matches!(task, Task::Bound(_)) && net.time().is_none();
        let few = Budget { limits: budget.half(), ..*budget };
        does.then(|| Bid::few(Bid::SEARCH, &few, OMEGAS))
    }

    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding {
        let bounds = bounds_within(net.pt(), &budget.limits);
        if bounds.is_ok_and(|it| it.iter().all(Option::is_some)) {
            return Finding::unsuited();
        }
        Coverability.find(net, task, budget)
    }
}

/// Tokens of a marking on the path to which something is looked for that can be repeated.
const MANY: u64 = 50;

/// Returns a sequence that can be repeated for ever and each time adds tokens to places: the first
/// that makes the net unbounded, or else a part of the path to many tokens in one of them. There
/// may be none: tokens that grow in a place can be moved to another one.
pub(crate) fn growth(pt: &Pt, places: &[PlaceId], budget: &Budget<'_>) -> Option<Evidence> {
    let limits = budget.coverability();
    if let Bounded::No(growth) = bounded(pt, &limits)
        && growth.grows.iter().any(|it| places.contains(&it.0))
    {
        return growth.evidence(pt);
    }
    let set = CoverabilitySet::new(pt, &limits).ok()?;
    places.iter().find_map(|&place| {
        let path = set.covers(&[(place, MANY)])?.firings.filter(|it| it.len() <= 2_000)?;
        let fired = |marking: &mut Vec<u32>, it: &TransitionId| {
            let after = pt.fire(marking, it.0)?;
            Some(std::mem::replace(marking, after))
        };
        let mut last = pt.initial.clone();
        let mut markings: Vec<Vec<u32>> =
            path.iter().map_while(|it| fired(&mut last, it)).collect();
        markings.push(last);
        let grows = |from: &[u32], to: &[u32]| {
            from[place.0 as usize] < to[place.0 as usize]
                && from.iter().zip(to).all(|(from, to)| from <= to)
        };
        let mut pairs = (0..markings.len()).flat_map(|to| (0..to).map(move |from| (from, to)));
        let (from, to) = pairs.find(|&(from, to)| grows(&markings[from], &markings[to]))?;
        Some(Evidence::growth(pt, &path[..from], &path[from..to]))
    })
}

fn covered(set: &CoverabilitySet<'_>, task: Task<'_>) -> Found {
    let Task::Bound(sum) = task else { return Found::Dead(set.dead_transitions()) };
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
            Ok(most) => {
                Found::Most(Extent::of(most + i128::from(sum.constant)), None, Evidence::None)
            }
            Err(_) => Found::Nothing(Reason::Undecided),
        },
    }
}
