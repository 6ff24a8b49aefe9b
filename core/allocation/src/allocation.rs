//! The answers of an allocator, and the trait that both allocators share.

use crate::problem::Problem;

pub use cotama_units::memory::MemoryError;

/// An allocator: picks one candidate an activity.
///
/// ```
/// use cotama_core::allocation::{Allocator, Answer};
/// use cotama_core::exact::{Exact, Item, Objective, Stage};
/// use cotama_core::panorama::Panorama;
/// use cotama_core::problem::{Candidate, Problem};
///
/// let c = |duration, energy, quality| Candidate { cost: [duration, energy], quality, id: 0 };
/// let (a, b) = ([c(5, 1, 2), c(1, 2, 9)], [c(5, 1, 2)]);
/// let activities = [&a[..], &b[..]];
/// let problem = Problem::new(&activities, [10, 9], [0, 1]).unwrap();
/// fn quality(by: &mut impl Allocator<2>, problem: &Problem<'_, 2>) -> Option<u64> {
///     match by.allocate(problem, &mut [0; 2]) {
///         Ok(Answer::Planned(planned)) => Some(planned.quality),
///         _ => None,
///     }
/// }
/// let (mut items, mut stages) = ([Item::EMPTY; 3], [Stage::EMPTY; 2]);
/// let mut exact = Exact::new(&[Objective::MostQuality], 1_000, &mut items, &mut stages);
/// assert_eq!(quality(&mut Panorama::new(&mut [[0; 2]; 2]), &problem), Some(11));
/// assert_eq!(quality(&mut exact, &problem), Some(11));
/// ```
pub trait Allocator<const A: usize> {
    /// Writes the chosen candidate of each activity to `plan` and says what is known of it.
    ///
    /// `plan` is written only when the answer is [`Answer::Planned`].
    ///
    /// # Errors
    /// [`MemoryError`] when `plan` or the allocator's memory is too small for the problem.
    fn allocate(
        &mut self,
        problem: &Problem<'_, A>,
        plan: &mut [u16],
    ) -> Result<Answer<A>, MemoryError>;
}

/// The answer of an allocator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer<const A: usize> {
    /// A plan within every limit.
    Planned(Planned<A>),
    /// No plan: proven by [`Exact`](crate::exact::Exact), and all that the paper's rule can say in
    /// [`Panorama`](crate::panorama::Panorama), which can miss a plan.
    Infeasible {
        /// The limit that is not met; `None` when the step budget ended before it was known which.
        shortfall: Option<Shortfall>,
        /// The work done, in the allocator's steps.
        steps: u64,
    },
    /// The step budget ended the search before a plan was found or excluded.
    Unknown {
        /// No plan has an objective above this.
        bound: u64,
        /// The work done, in the allocator's steps.
        steps: u64,
    },
}

/// A limit that is not met: the first in the order of treatment at which the search failed.
///
/// *Invariant:* the least total is above the limit.
///
/// ```
/// use cotama_core::allocation::Shortfall;
/// let energy = Shortfall::new(1, 3_000, 3_200).unwrap();
/// assert_eq!((energy.axis(), energy.limit()), (1, 3_000));
/// assert_eq!((energy.least(), energy.gap()), (3_200, 200));
/// assert_eq!(Shortfall::new(1, 3_000, 3_000), None); // a limit is inclusive: this one is met
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortfall {
    axis: usize,
    limit: u64,
    least: u64,
}

impl Shortfall {
    /// Returns the shortage on an axis, or `None` when the least total is within the limit.
    #[must_use]
    pub const fn new(axis: usize, limit: u64, least: u64) -> Option<Self> {
        if least > limit { Some(Self { axis, limit, least }) } else { None }
    }

    /// The axis.
    #[must_use]
    pub const fn axis(&self) -> usize {
        self.axis
    }

    /// Returns the inclusive limit of the axis.
    #[must_use]
    pub const fn limit(&self) -> u64 {
        self.limit
    }

    /// The least total on the axis with the limits treated before it kept: of all plans for
    /// [`Exact`](crate::exact::Exact), as far as its rule goes for
    /// [`Panorama`](crate::panorama::Panorama).
    #[must_use]
    pub const fn least(&self) -> u64 {
        self.least
    }

    /// The least total less the limit; never zero.
    #[must_use]
    pub const fn gap(&self) -> u64 {
        self.least.saturating_sub(self.limit)
    }
}

/// A plan within every limit, and how good it is known to be.
///
/// ```
/// use cotama_core::allocation::{Allocator, Answer};
/// use cotama_core::exact::{Exact, Item, Objective, Stage};
/// use cotama_core::problem::{Candidate, Problem};
///
/// let c = |energy, quality| Candidate { cost: [energy], quality, id: 0 };
/// let (a, b) = ([c(3, 1), c(8, 5)], [c(2, 1), c(6, 4)]);
/// let activities = [&a[..], &b[..]];
/// let problem = Problem::new(&activities, [10], [0]).unwrap();
/// let (mut items, mut stages) = ([Item::EMPTY; 4], [Stage::EMPTY; 2]);
/// let mut exact = Exact::new(&[Objective::MostQuality], 1_000, &mut items, &mut stages);
/// let Ok(Answer::Planned(planned)) = exact.allocate(&problem, &mut [0; 2]) else { panic!() };
/// assert_eq!((planned.cost, planned.quality), ([10], 6));
/// assert_eq!((planned.bound, planned.optimal), (Some(6), true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Planned<const A: usize> {
    /// The total cost on each axis.
    pub cost: [u64; A],
    /// The total quality.
    pub quality: u64,
    /// A proven bound on the objective: no plan within the limits has more (less, for a minimised
    /// axis). `None` where the allocator proves nothing, or was given no objective.
    pub bound: Option<u64>,
    /// Whether the bound is met, so that no plan is better.
    pub optimal: bool,
    /// The work done, in the allocator's steps.
    pub steps: u64,
}
