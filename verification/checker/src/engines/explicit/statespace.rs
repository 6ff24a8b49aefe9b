//! How large a net is.

use super::explore::{End, explore};
use super::figures::{OF_AN_UNBOUNDED_NET, StateSpace};
use super::growth::growth;
use super::layout::Width;
use super::plan::Plan;
use super::space::{Search, Space, TooNarrow, search};
use super::{Limit, Limits, Progress, wide};
use cotama_core::net::TransitionId;
use cotama_property::pt::Pt;

/// Passes through all reachable markings, on so many threads; and, when growth without end is found
/// first, through some.
///
/// All counts are the same on any number of threads, but for limits of memory and time. `progress`
/// is called by this thread now and then.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::explicit::{Limits, statespace};
/// use cotama_verification::pt::Pt;
/// let net = philosophers(5).unwrap();
/// let space = statespace(&Pt::from(&net.view().net()), &Limits::default(), 2, &|_| {});
/// assert_eq!((space.states, space.dead_markings, space.max_place), (243, 2, 1));
/// ```
pub fn statespace(
    pt: &Pt,
    limits: &Limits,
    jobs: usize,
    progress: &dyn Fn(Progress),
) -> StateSpace {
    let widths = match Width::of(pt, limits) {
        Ok(widths) => widths,
        Err(limit) => return StateSpace::none(pt, limit),
    };
    let is_bounded = widths.iter().all(|it| it.proved);
    let growth = if is_bounded { None } else { growth(pt, limits) };
    let few = Limits { states: limits.states.min(OF_AN_UNBOUNDED_NET), ..*limits };
    let limits = if growth.is_some() { &few } else { limits };
    let plan = Plan { pt, limits, jobs, progress, goal: None };
    let mut found = search(pt, widths, &mut Count { plan })
        .or_else(|limit| match limit {
            Limit::Words => wide::statespace(pt, limits, progress),
            limit => Err(limit),
        })
        .unwrap_or_else(|limit| StateSpace::none(pt, limit));
    found.bounded = match growth {
        Some(_) => Some(false),
        None => (is_bounded || found.limit.is_none()).then_some(true),
    };
    if growth.is_some() && found.limit == Some(Limit::States) {
        found.limit = Some(Limit::Unbounded);
    }
    found.growth = growth;
    found
}

struct Count<'c> {
    plan: Plan<'c>,
}

impl Search for Count<'_> {
    type Found = StateSpace;

    fn search<const S: usize>(&mut self, space: Space) -> Result<StateSpace, TooNarrow> {
        let explored = explore::<S>(&space, self.plan)?;
        let tally = explored.tally;
        let most = tally.seen.most(&space.enabling, &space.layout);
        let transitions = 0..self.plan.pt.transitions.len() as u32;
        let dead = transitions.filter(|it| tally.enabled[*it as usize / 64] >> (it % 64) & 1 == 0);
        Ok(StateSpace {
            states: explored.states,
            arcs: tally.arcs,
            max_place: most.iter().copied().max().unwrap_or(0),
            max_sum: tally.sum,
            bounds: most,
            dead_markings: tally.dead,
            dead_transitions: dead.map(TransitionId).collect(),
            depth: explored.depth.saturating_sub(1),
            limit: match explored.end {
                End::Limit(limit) => Some(limit),
                End::Exhausted | End::Found => None,
            },
            bounded: None,
            growth: None,
            bytes: explored.bytes,
            peak: explored.peak,
        })
    }
}
