//! The allocator of the paper: limits one after the other, candidates lowered from the last
//! activity back.
//!
//! Lambert et al., J. Intell. Robot. Syst. 110, 2024, Section 7.2.2:
//!
//! 1. Limits are treated in their order. For each, every activity starts at its highest candidate;
//!    while the sum is above the limit, the last activity is lowered to its highest candidate that
//!    meets the limit, or to its lowest if none does, and the one before follows.
//! 2. After each limit, every candidate above the chosen value of its activity is dropped.
//! 3. The plan is the highest on the last axis of what is left; of equal ones the first.
//!
//! A replan (rules 4 and 5) is the same over what is left of the mission; see [`crate::monitor`].
//!
//! The rule is fast and keeps spare resources in use, but it can miss a plan that exists:
//!
//! ```
//! use cotama_core::allocation::{Allocator, Answer, Shortfall};
//! use cotama_core::panorama::Panorama;
//! use cotama_core::problem::{Candidate, Problem};
//!
//! let c = |duration, energy| Candidate { cost: [duration, energy], quality: 0, id: 0 };
//! let (a, b) = ([c(5, 1), c(1, 2)], [c(5, 1), c(1, 10)]);
//! let activities = [&a[..], &b[..]];
//! let mut plan = [0; 2];
//! let mut caps = [[0; 2]; 2];
//! let mut rule = Panorama::new(&mut caps);
//!
//! let duration_first = Problem::new(&activities, [6, 3], [0, 1]).unwrap();
//! let Ok(Answer::Infeasible { shortfall, .. }) = rule.allocate(&duration_first, &mut plan) else {
//!     panic!("the rule finds a plan")
//! };
//! assert_eq!(shortfall, Shortfall::new(1, 3, 11)); // 11 mJ where 3 mJ is the limit
//! let energy_first = Problem::new(&activities, [6, 3], [1, 0]).unwrap();
//! assert!(matches!(rule.allocate(&energy_first, &mut plan), Ok(Answer::Planned(_))));
//! assert_eq!(plan, [1, 0]);
//! ```

#[cfg(kani)]
pub mod proofs;

use crate::allocation::{Allocator, Answer, MemoryError, Planned, Shortfall};
use crate::order::numbered;
use crate::problem::{Candidate, Problem};
use cotama_units::memory::enough;

/// The paper's allocator, in memory from its caller. A step is one candidate looked at.
///
/// ```
/// use cotama_core::allocation::{Allocator, Answer};
/// use cotama_core::panorama::Panorama;
/// use cotama_core::problem::{Candidate, Problem};
///
/// let c = |duration| Candidate { cost: [duration], quality: 0, id: 0 };
/// let ways = [c(9), c(5), c(2)];
/// let activities = [&ways[..], &ways[..]];
/// let problem = Problem::new(&activities, [12], [0]).unwrap();
/// let (mut caps, mut plan) = ([[0]; 2], [0; 2]);
/// let Ok(Answer::Planned(planned)) = Panorama::new(&mut caps).allocate(&problem, &mut plan) else {
///     panic!("there is a plan")
/// };
/// assert_eq!((plan, planned.cost), ([0, 2], [11])); // the last activity is lowered first
/// ```
#[derive(Debug)]
pub struct Panorama<'m, const A: usize> {
    caps: &'m mut [[u32; A]],
}

impl<'m, const A: usize> Panorama<'m, A> {
    /// An allocator in this memory: one element an activity.
    pub const fn new(caps: &'m mut [[u32; A]]) -> Self {
        Self { caps }
    }
}

/// Whether a candidate has survived the limits treated so far (rule 2).
fn left<const A: usize>(candidate: &Candidate<A>, caps: &[u32; A]) -> bool {
    candidate.cost.iter().zip(caps).all(|(cost, cap)| cost <= cap)
}

/// A candidate's cost on an axis.
fn on<const A: usize>(candidate: &Candidate<A>, axis: usize) -> u32 {
    debug_assert!(axis < A, "the order of treatment names axes");
    candidate.cost.get(axis).copied().unwrap_or(0)
}

fn set<const A: usize>(caps: &mut [u32; A], axis: usize, most: u32) {
    debug_assert!(axis < A, "the order of treatment names axes");
    if let Some(cap) = caps.get_mut(axis) {
        *cap = most;
    }
}

impl<const A: usize> Allocator<A> for Panorama<'_, A> {
    fn allocate(
        &mut self,
        problem: &Problem<'_, A>,
        plan: &mut [u16],
    ) -> Result<Answer<A>, MemoryError> {
        let activities = problem.activities();
        enough("plan", activities.len(), plan.len())?;
        enough("caps of the paper's rule", activities.len(), self.caps.len())?;

        let caps = self.caps.get_mut(..activities.len()).unwrap_or(&mut []);
        let mut steps = 0u64;
        // The highest on every axis in one pass. It changes only where a candidate is dropped.
        for (candidates, caps) in activities.iter().zip(caps.iter_mut()) {
            *caps = [0; A];
            for candidate in *candidates {
                for (cap, &cost) in caps.iter_mut().zip(&candidate.cost) {
                    *cap = cost.max(*cap);
                }
            }
            steps = steps.saturating_add(candidates.len() as u64);
        }
        // Activities before this one have not been lowered.
        let mut lowered = activities.len();
        for axis in problem.order() {
            let Some(&limit) = problem.limits().get(axis) else { continue };
            for (candidates, caps) in activities.iter().zip(caps.iter_mut()).skip(lowered) {
                let left = candidates.iter().filter(|c| left(c, caps));
                let most = left.fold(0, |most, c| on(c, axis).max(most));
                set(caps, axis, most);
                steps = steps.saturating_add(candidates.len() as u64);
            }
            let most = caps.iter().filter_map(|caps| caps.get(axis));
            let mut sum = most.fold(0u64, |sum, &most| sum.saturating_add(u64::from(most)));
            let mut at = activities.len();
            for (candidates, caps) in activities.iter().zip(caps.iter_mut()).rev() {
                if sum <= limit {
                    break;
                }
                // Rule 1. The paper sorts what is left and searches by dichotomy; one pass finds
                // the same.
                let highest = caps.get(axis).copied().unwrap_or(0);
                debug_assert!(u64::from(highest) <= sum, "an activity is part of the sum");
                let others = sum.saturating_sub(u64::from(highest));
                let room = limit.saturating_sub(others);
                let (mut fitting, mut lowest) = (None, highest);
                for cost in candidates.iter().filter(|c| left(c, caps)).map(|c| on(c, axis)) {
                    lowest = lowest.min(cost);
                    if u64::from(cost) <= room {
                        fitting = fitting.max(Some(cost));
                    }
                }
                steps = steps.saturating_add(candidates.len() as u64);
                let chosen = fitting.unwrap_or(lowest);
                set(caps, axis, chosen);
                sum = others.saturating_add(u64::from(chosen));
                at = at.wrapping_sub(1);
            }
            if let Some(shortfall) = Shortfall::new(axis, limit, sum) {
                return Ok(Answer::Infeasible { shortfall: Some(shortfall), steps });
            }
            lowered = lowered.min(at);
        }

        let mut cost = [0; A];
        let mut quality = 0u64;
        let last_axis = problem.order().last().copied();
        for ((candidates, caps), choice) in activities.iter().zip(caps.iter()).zip(plan.iter_mut())
        {
            // Rule 3: one that is left has the cost that the last axis was lowered to.
            let most = last_axis.and_then(|axis| Some((axis, *caps.get(axis)?)));
            let highest = |c: &Candidate<A>| most.is_none_or(|(axis, most)| on(c, axis) == most);
            let found = numbered(candidates.iter()).find(|(_, c)| highest(c) && left(c, caps));
            debug_assert!(found.is_some(), "an activity is lowered to a candidate that is left");
            let Some((index, candidate)) = found else { continue };
            *choice = index as u16;
            for (sum, &part) in cost.iter_mut().zip(&candidate.cost) {
                *sum = u64::saturating_add(*sum, u64::from(part));
            }
            quality = quality.saturating_add(u64::from(candidate.quality));
            steps = steps.saturating_add(index as u64).saturating_add(1);
        }
        debug_assert!(problem.within_limits(&cost), "a plan keeps the limits");
        Ok(Answer::Planned(Planned { cost, quality, bound: None, optimal: false, steps }))
    }
}
