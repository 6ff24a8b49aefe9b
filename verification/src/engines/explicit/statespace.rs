//! How large a net is.

use super::explore::{End, explore};
use super::growth::{Growth, growth};
use super::layout::Width;
use super::plan::Plan;
use super::space::{Search, Space, TooNarrow, search};
use super::{Limit, Limits, Progress, wide};
use crate::pt::Pt;
use cotama_core::net::TransitionId;

/// What is counted of the reachable markings; with a [`StateSpace::limit`], of those that were
/// reached.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateSpace {
    /// Markings.
    pub states: u64,
    /// Pairs of a marking and a transition that is enabled in it.
    pub arcs: u64,
    /// The most tokens of a place.
    pub max_place: u64,
    /// The most tokens of all places together.
    pub max_sum: u64,
    /// For each place the most tokens it held.
    pub bounds: Vec<u64>,
    /// Markings that enable no transition.
    pub dead_markings: u64,
    /// Transitions that are enabled in no marking.
    pub dead_transitions: Vec<TransitionId>,
    /// The most firings that a marking is away from the initial one.
    pub depth: u64,
    /// Why there can be more; `None`: these are all.
    pub limit: Option<Limit>,
    /// Whether there is a most number of tokens for every place; `None`: unknown.
    pub bounded: Option<bool>,
    /// How tokens grow without end, if that was found.
    pub growth: Option<Growth>,
    /// Bytes at the end: tables and lists of markings.
    pub bytes: u64,
    /// The most bytes at any time.
    pub peak: u64,
}

impl StateSpace {
    /// Whether no place ever holds more than one token; `None`: unknown.
    pub fn safe(&self) -> Option<bool> {
        (self.max_place > 1 || self.limit.is_none()).then_some(self.max_place <= 1)
    }

    fn none(pt: &Pt, limit: Limit) -> Self {
        Self {
            states: 0,
            arcs: 0,
            max_place: 0,
            max_sum: 0,
            bounds: vec![0; pt.places.len()],
            dead_markings: 0,
            dead_transitions: Vec::new(),
            depth: 0,
            limit: Some(limit),
            bounded: None,
            growth: None,
            bytes: 0,
            peak: 0,
        }
    }

    /// Bytes for each marking.
    #[allow(clippy::cast_precision_loss)] // a mean needs no more than a double's digits
    pub fn bytes_per_state(&self) -> f64 {
        self.bytes as f64 / self.states.max(1) as f64
    }
}

/// Markings of an unbounded net that are passed through.
const OF_AN_UNBOUNDED_NET: u64 = 1 << 16;

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
