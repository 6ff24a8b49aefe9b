//! The allocation problem: activities in sequence, one candidate each, additive costs with limits.
//!
//! Lambert et al., J. Intell. Robot. Syst. 110, 2024: a mission is split into *activities*; an
//! *implementation alternative* (here: [`Candidate`]) of an activity costs an amount on each
//! *performance axis*; an end-oriented goal limits the sum over all activities, inclusively.

#[cfg(kani)]
pub mod proofs;

/// One implementation alternative of an activity, as the allocators see it.
///
/// Costs are in the unit of their axis (the missions use ms and mJ). They are 32 bits wide and sums
/// are 64 bits wide, so with at most [`Problem::MAX_ACTIVITIES`] activities no sum can overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidate<const A: usize> {
    /// The cost on each axis.
    pub cost: [u32; A],
    /// How good the activity is done this way; larger is better. Qualities add up.
    pub quality: u32,
    /// The caller's own number for this alternative; the allocators never read it.
    pub id: u16,
}

/// An allocation problem over `A` additive axes. It borrows its tables, so that firmware keeps them
/// in flash.
///
/// ```
/// use cotama_core::problem::{Candidate, Problem};
/// const FAST: Candidate<2> = Candidate { cost: [1, 10], quality: 1, id: 0 };
/// const SLOW: Candidate<2> = Candidate { cost: [5, 1], quality: 1, id: 1 };
/// static ACTIVITIES: [&[Candidate<2>]; 2] = [&[FAST, SLOW], &[FAST]];
/// let problem = Problem::new(&ACTIVITIES, [6, 11], [0, 1]).unwrap();
/// assert_eq!(problem.combinations(), Some(2));
/// assert_eq!(problem.totals(&[1, 0]), Some(([6, 11], 2)));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a, const A: usize> {
    activities: &'a [&'a [Candidate<A>]],
    limits: [u64; A],
    order: [usize; A],
}

/// Why the parts do not make a problem.
///
/// ```
/// use cotama_core::problem::{Candidate, Problem, ProblemError};
///
/// let ways = [Candidate { cost: [7, 3], quality: 1, id: 0 }];
/// let (lacks, full) = ([&ways[..], &[]], [&ways[..]]);
/// let error = Problem::new(&lacks, [9, 9], [0, 1]).unwrap_err();
/// assert_eq!(error.to_string(), "activity 1 has no candidate");
/// assert_eq!(Problem::new(&full, [9, 9], [0, 0]).unwrap_err(), ProblemError::BadOrder);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProblemError {
    /// This activity has no candidate.
    NoCandidates {
        /// Position of the activity in the sequence.
        activity: usize,
    },
    /// This activity has more candidates than [`Problem::MAX_CANDIDATES`].
    TooManyCandidates {
        /// Position of the activity in the sequence.
        activity: usize,
    },
    /// There are more activities than [`Problem::MAX_ACTIVITIES`].
    TooManyActivities,
    /// The order of treatment does not name every axis once.
    BadOrder,
}

impl core::fmt::Display for ProblemError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoCandidates { activity } => write!(f, "activity {activity} has no candidate"),
            Self::TooManyCandidates { activity } => {
                write!(
                    f,
                    "activity {activity} has more than {} candidates",
                    Problem::<0>::MAX_CANDIDATES
                )
            }
            Self::TooManyActivities => {
                write!(f, "more than {} activities", Problem::<0>::MAX_ACTIVITIES)
            }
            Self::BadOrder => f.write_str("the order of treatment must name every axis once"),
        }
    }
}

impl core::error::Error for ProblemError {}

impl<'a, const A: usize> Problem<'a, A> {
    /// The most activities of a problem.
    pub const MAX_ACTIVITIES: usize = u16::MAX as usize;
    /// The most candidates of an activity.
    pub const MAX_CANDIDATES: usize = u16::MAX as usize;

    /// A problem from its activities, the inclusive limit of each axis, and the order in which the
    /// axes are treated.
    ///
    /// # Errors
    /// A [`ProblemError`] for an activity without candidates, for too many of them, or for a bad
    /// order.
    pub const fn new(
        activities: &'a [&'a [Candidate<A>]],
        limits: [u64; A],
        order: [usize; A],
    ) -> Result<Self, ProblemError> {
        if activities.len() > Self::MAX_ACTIVITIES {
            return Err(ProblemError::TooManyActivities);
        }
        let mut activity = 0;
        while activity < activities.len() {
            if activities[activity].is_empty() {
                return Err(ProblemError::NoCandidates { activity });
            }
            if activities[activity].len() > Self::MAX_CANDIDATES {
                return Err(ProblemError::TooManyCandidates { activity });
            }
            activity += 1;
        }
        if !names_every_axis_once(&order) {
            return Err(ProblemError::BadOrder);
        }
        Ok(Self { activities, limits, order })
    }

    /// The candidates of each activity.
    #[must_use]
    pub const fn activities(&self) -> &'a [&'a [Candidate<A>]] {
        self.activities
    }

    /// The inclusive limit of each axis.
    #[must_use]
    pub const fn limits(&self) -> [u64; A] {
        self.limits
    }

    /// The axes in their order of treatment.
    #[must_use]
    pub const fn order(&self) -> [usize; A] {
        self.order
    }

    /// The same activities under other limits.
    #[must_use]
    pub const fn with_limits(self, limits: [u64; A]) -> Self {
        Self { limits, ..self }
    }

    /// How many plans there are, feasible or not; `None` when the number passes 128 bits.
    #[must_use]
    pub fn combinations(&self) -> Option<u128> {
        self.activities
            .iter()
            .try_fold(1u128, |product, candidates| product.checked_mul(candidates.len() as u128))
    }

    /// The cost on each axis and the quality of a plan; `None` when it is not a plan of this
    /// problem.
    #[must_use]
    pub fn totals(&self, plan: &[u16]) -> Option<([u64; A], u64)> {
        if plan.len() != self.activities.len() {
            return None;
        }
        let mut cost = [0; A];
        let mut quality = 0;
        for (candidates, &choice) in self.activities.iter().zip(plan) {
            let candidate = candidates.get(usize::from(choice))?;
            for (sum, &part) in cost.iter_mut().zip(&candidate.cost) {
                *sum = u64::saturating_add(*sum, u64::from(part));
            }
            quality = u64::saturating_add(quality, u64::from(candidate.quality));
        }
        Some((cost, quality))
    }

    /// Whether these costs are within every limit.
    #[must_use]
    pub fn within_limits(&self, cost: &[u64; A]) -> bool {
        cost.iter().zip(&self.limits).all(|(cost, limit)| cost <= limit)
    }

    /// The least total cost on one axis, whatever the others; nothing on an axis that there is not.
    #[must_use]
    pub fn least(&self, axis: usize) -> u64 {
        let costs = self.activities.iter().map(|candidates| cheapest(candidates, axis));
        costs.fold(0, |sum, cost| sum.saturating_add(u64::from(cost)))
    }
}

/// The least cost on one axis among the candidates of an activity.
pub(crate) fn cheapest<const A: usize>(candidates: &[Candidate<A>], axis: usize) -> u32 {
    candidates.iter().filter_map(|c| c.cost.get(axis).copied()).min().unwrap_or(0)
}

/// Whether an order of treatment is one.
pub(crate) const fn names_every_axis_once<const A: usize>(order: &[usize; A]) -> bool {
    let mut axis = 0;
    while axis < A {
        let mut named = 0;
        let mut place = 0;
        while place < A {
            named += (order[place] == axis) as usize;
            place += 1;
        }
        if named != 1 {
            return false;
        }
        axis += 1;
    }
    true
}
