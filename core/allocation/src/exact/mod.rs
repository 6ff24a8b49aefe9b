//! The complete allocator: the best plan within all limits, or the proof that there is none.
//!
//! The problem is a multiple-choice knapsack with several limits. The search uses what that gives:
//!
//! 1. *Dominance*: a candidate that another of its activity beats on every axis and in value is
//!    dropped.
//! 2. *Lagrangian bound* (`dual`): prices for the limits, minimised; at these prices every
//!    candidate has a *reduced cost* against the best of its activity, and a plan is worth the
//!    bound less its reduced costs less the priced slack.
//! 3. *A first plan* (`primal`): the best candidates at these prices, repaired and improved.
//! 4. *Remainders* (`congruence`): where many activities share a ratio of value to cost, plans near
//!    the bound are worth the same modulo a small number, and the bound falls to the next value
//!    that can be reached.
//! 5. *Search by rising reduced cost* (`search`): is there a plan within a given reduced cost of
//!    the bound? For a small reduced cost few candidates qualify, and the answer takes few nodes.
//!    Each "no" lowers the proven bound, the first "yes" raises the plan, until both meet. At every
//!    node the rest is priced anew with several multipliers.
//!
//! It is anytime: a step budget goes in, the best plan so far and a proven bound come out.
//!
//! *Tie rule.* Candidates are put in an order that depends on their numbers alone, and the search
//! is deterministic, so the plan does not depend on the order in which candidates are written; of
//! candidates equal in every number the first written is taken. A lexicographic order of objectives
//! settles the rest.
//!
//! ```
//! use cotama_core::allocation::{Allocator, Answer};
//! use cotama_core::exact::{Exact, Item, Objective, Stage};
//! use cotama_core::problem::{Candidate, Problem};
//!
//! // The paper's rule finds no plan here, in neither order of the limits.
//! let c = |duration, energy| Candidate { cost: [duration, energy], quality: 0, id: 0 };
//! let (a, b) = ([c(1, 3), c(2, 5)], [c(1, 5), c(4, 1), c(3, 2)]);
//! let activities = [&a[..], &b[..]];
//! let problem = Problem::new(&activities, [4, 5], [0, 1]).unwrap();
//!
//! let (mut items, mut stages) = ([Item::EMPTY; 5], [Stage::EMPTY; 2]);
//! let mut exact = Exact::new(&[Objective::Least(1)], 1_000, &mut items, &mut stages);
//! let mut plan = [0; 2];
//! let Ok(Answer::Planned(planned)) = exact.allocate(&problem, &mut plan) else {
//!     panic!("there is a plan")
//! };
//! assert_eq!((plan, planned.cost, planned.optimal), ([0, 2], [4, 5], true));
//! ```

mod bounds;
mod congruence;
mod dive;
mod dual;
mod item;
mod level;
mod load;
mod memory;
mod primal;
#[cfg(kani)]
pub mod proofs;
mod rows;
mod search;
#[cfg(feature = "alloc")]
mod workspace;

use crate::allocation::{Allocator, Answer, MemoryError, Planned, Shortfall};
use crate::problem::{Candidate, Problem};
use congruence::Remainders;
use cotama_units::memory::enough;
pub use item::Item;
use load::Aim;
pub use memory::{Seen, Stage};
#[cfg(feature = "alloc")]
pub use workspace::Workspace;

/// The criterion by which a plan is chosen.
///
/// ```
/// use cotama_core::allocation::Allocator;
/// use cotama_core::exact::{Exact, Item, Objective, Stage};
/// use cotama_core::problem::{Candidate, Problem};
///
/// // Three ways: the best two are equal in quality, and differ in energy.
/// let c = |energy, quality| Candidate { cost: [energy], quality, id: 0 };
/// let ways = [c(3, 1), c(9, 5), c(7, 5)];
/// let activities = [&ways[..]];
/// let problem = Problem::new(&activities, [10], [0]).unwrap();
/// let best = |objectives: &[Objective]| {
///     let (mut items, mut stages, mut plan) = ([Item::EMPTY; 3], [Stage::EMPTY; 1], [0]);
///     Exact::new(objectives, 100, &mut items, &mut stages).allocate(&problem, &mut plan).unwrap();
///     plan[0]
/// };
/// assert_eq!(best(&[Objective::Least(0)]), 0);
/// assert_eq!(best(&[Objective::Most(0)]), 1);
/// assert_eq!(best(&[Objective::MostQuality, Objective::Least(0)]), 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// The most total quality.
    MostQuality,
    /// The least total cost on this axis; an axis that the problem does not have costs nothing.
    Least(usize),
    /// The most total cost on this axis, within its limit: use what there is. It is not a limit for
    /// objectives after it, so these are not treated.
    Most(usize),
}

impl Objective {
    /// The amount this objective is about, in a plan with these totals.
    fn amount<const A: usize>(self, cost: &[u64; A], quality: u64) -> u64 {
        match self {
            Self::MostQuality => quality,
            Self::Least(axis) | Self::Most(axis) => cost.get(axis).copied().unwrap_or(0),
        }
    }
}

/// A number of steps that may still be taken. A step is one activity priced, or one node of the
/// search.
#[derive(Clone, Copy, Debug)]
struct Budget {
    left: u64,
}

impl Budget {
    /// Takes steps; `None`, and nothing taken, when fewer are left.
    #[inline]
    fn take(&mut self, steps: u64) -> Option<()> {
        self.left = self.left.checked_sub(steps)?;
        Some(())
    }
}

/// The complete allocator, in memory from its caller. With feature `alloc`, a `Workspace` provides
/// the memory.
///
/// ```
/// use cotama_core::allocation::{Allocator, Answer};
/// use cotama_core::exact::{Exact, Item, Objective, Seen, Stage};
/// use cotama_core::problem::{Candidate, Problem};
///
/// let c = |energy, quality| Candidate { cost: [energy], quality, id: 0 };
/// let ways = [c(2, 1), c(4, 3), c(9, 4)];
/// let activities = [&ways[..]; 3];
/// let problem = Problem::new(&activities, [15], [0]).unwrap();
/// let (mut items, mut stages) = ([Item::EMPTY; 9], [Stage::EMPTY; 3]);
/// let (mut seen, mut plan) = ([Seen::EMPTY; 64], [0; 3]);
/// let exact = Exact::new(&[Objective::MostQuality], 10_000, &mut items, &mut stages);
/// let answer = exact.with_memory(&mut seen).allocate(&problem, &mut plan);
/// let Ok(Answer::Planned(planned)) = answer else { panic!() };
/// assert_eq!((plan, planned.quality, planned.optimal), ([1, 1, 1], 9, true));
/// ```
#[derive(Debug)]
pub struct Exact<'m, const A: usize> {
    objectives: &'m [Objective],
    steps: u64,
    items: &'m mut [Item<A>],
    stages: &'m mut [Stage<A>],
    seen: &'m mut [Seen<A>],
}

/// How the search for one objective ended; values are of whole plans, larger is better.
enum Ended {
    /// The plan in `Stage::best` is proven best.
    Optimal,
    /// The plan in `Stage::best` is the best so far; none has more value than this.
    Stopped(i128),
    /// There is no plan.
    Infeasible,
    /// No plan was found; no plan has more value than this.
    Unknown(i128),
}

impl<'m, const A: usize> Exact<'m, A> {
    /// An allocator for `objectives` in lexicographic order (none: any plan within the limits),
    /// that takes at most `steps` steps; `items` and `stages` hold one element a candidate and one
    /// an activity.
    pub const fn new(
        objectives: &'m [Objective],
        steps: u64,
        items: &'m mut [Item<A>],
        stages: &'m mut [Stage<A>],
    ) -> Self {
        Self { objectives, steps, items, stages, seen: &mut [] }
    }

    /// The same with memory for nodes that need not be searched twice, as many as there is room
    /// for. It pays where many activities share a ratio of value to cost; elsewhere it costs a
    /// little time.
    #[must_use]
    pub fn with_memory(self, seen: &'m mut [Seen<A>]) -> Self {
        Self { seen, ..self }
    }

    /// The search for one objective; the plan is left in [`Stage::best`].
    fn pursue(&mut self, problem: &Problem<'_, A>, aim: &Aim<A>, budget: &mut Budget) -> Ended {
        let stages = self.stages.get_mut(..problem.activities().len()).unwrap_or(&mut []);
        let Some(frame) = load::load(problem, aim, self.items, stages) else {
            return Ended::Infeasible;
        };
        let value = |above: i64| frame.least_value.wrapping_add(i128::from(above));
        let mut dual = dual::Dual { frame: &frame, items: self.items, stages, budget };
        let Some(price) = dual.minimise() else { return Ended::Unknown(value(frame.most)) };
        if price.bound < 0 {
            return Ended::Infeasible;
        }
        let mut bound = frame.whole(price.bound).min(frame.most);
        let best = primal::first_plan(&frame, &price, self.items, stages, budget);
        if best.is_none() {
            // A plan beyond the limits is no start for the search.
            stages.iter_mut().for_each(|stage| stage.best = 0);
        }
        let mut remainders = Remainders::of(&frame, self.items, stages);
        if !remainders.matter() || budget.take(stages.len() as u64).is_none() {
            remainders = Remainders::NONE;
        } else {
            bound = congruence::bound(&frame, &price, self.items, stages, &remainders, bound);
        }
        match search::search(
            &frame,
            &price,
            &remainders,
            self.items,
            stages,
            self.seen,
            best,
            &mut bound,
            budget,
        ) {
            (Some(best), _) if best >= bound => Ended::Optimal,
            (Some(_), _) => Ended::Stopped(value(bound)),
            (None, true) => Ended::Infeasible,
            (None, false) => Ended::Unknown(value(bound)),
        }
    }

    /// Copies the plan of the last pursuit.
    fn write(&self, plan: &mut [u16]) {
        for (choice, stage) in plan.iter_mut().zip(self.stages.iter()) {
            *choice = stage.item(self.items, stage.best).choice();
        }
    }

    /// The first limit in the order of treatment that no plan meets which keeps those before it;
    /// `None` when the budget ends before that is known. Needs a problem without a plan.
    fn shortfall(&mut self, problem: &Problem<'_, A>, budget: &mut Budget) -> Option<Shortfall> {
        let activities = problem.activities();
        let mut limits = [u64::MAX; A];
        for axis in problem.order() {
            let aim = Aim { objective: Some(Objective::Least(axis)), limits, quality_floor: 0 };
            let ended = self.pursue(problem, &aim, budget);
            if matches!(ended, Ended::Infeasible | Ended::Unknown(_)) {
                return None;
            }
            let own = |(stage, candidates): (&Stage<A>, &&[Candidate<A>])| {
                let choice = stage.item(self.items, stage.best).choice();
                let cost = candidates.get(usize::from(choice)).and_then(|c| c.cost.get(axis));
                u64::from(cost.copied().unwrap_or(0))
            };
            let costs = self.stages.iter().zip(activities).map(own);
            let total = costs.fold(0, u64::saturating_add);
            let (&limit, slot) = problem.limits().get(axis).zip(limits.get_mut(axis))?;
            if let Some(shortfall) = Shortfall::new(axis, limit, total) {
                // Without the proof that no plan has less, this limit may well be met.
                return matches!(ended, Ended::Optimal).then_some(shortfall);
            }
            *slot = limit;
        }
        None
    }
}

impl<const A: usize> Allocator<A> for Exact<'_, A> {
    fn allocate(
        &mut self,
        problem: &Problem<'_, A>,
        plan: &mut [u16],
    ) -> Result<Answer<A>, MemoryError> {
        let lengths = problem.activities().iter().map(|candidates| candidates.len());
        let candidates = lengths.fold(0, usize::saturating_add);
        enough("plan", problem.activities().len(), plan.len())?;
        enough("items of the exact allocator", candidates, self.items.len())?;
        enough("stages of the exact allocator", problem.activities().len(), self.stages.len())?;
        let plan = plan.get_mut(..problem.activities().len()).unwrap_or(&mut []);

        let mut budget = Budget { left: self.steps };
        let mut aim = Aim { objective: None, limits: problem.limits(), quality_floor: 0 };
        let mut found = None;
        // Without an objective any plan will do: one pursuit of nothing.
        let count = self.objectives.len().max(1);
        for place in 0..count {
            aim.objective = self.objectives.get(place).copied();
            let bound = match self.pursue(problem, &aim, &mut budget) {
                Ended::Optimal => None,
                Ended::Stopped(bound) => Some(bound),
                Ended::Infeasible if found.is_none() => {
                    let shortfall = self.shortfall(problem, &mut budget);
                    return Ok(Answer::Infeasible {
                        shortfall,
                        steps: self.steps.saturating_sub(budget.left),
                    });
                }
                Ended::Unknown(bound) if found.is_none() => {
                    let bound = u64::try_from(bound.unsigned_abs()).unwrap_or(u64::MAX);
                    return Ok(Answer::Unknown {
                        bound,
                        steps: self.steps.saturating_sub(budget.left),
                    });
                }
                // A later objective found nothing within the budget: the plan before it stands.
                Ended::Infeasible | Ended::Unknown(_) => {
                    found = found.map(|planned: Planned<A>| Planned { optimal: false, ..planned });
                    break;
                }
            };
            self.write(plan);
            debug_assert!(problem.totals(plan).is_some(), "each choice is a candidate");
            let (cost, quality) = problem.totals(plan).unwrap_or(([0; A], 0));
            debug_assert!(problem.within_limits(&cost), "a plan keeps the limits");
            debug_assert!(quality >= aim.quality_floor, "a plan keeps what is settled already");
            let amount = aim.objective.map(|objective| objective.amount(&cost, quality));
            let first_bound = found.and_then(|planned: Planned<A>| planned.bound);
            let own_bound =
                bound.map_or(amount, |b| Some(u64::try_from(b.unsigned_abs()).unwrap_or(u64::MAX)));
            found = Some(Planned {
                cost,
                quality,
                bound: first_bound.or(own_bound),
                optimal: bound.is_none(),
                steps: self.steps.saturating_sub(budget.left),
            });
            if bound.is_some() {
                break;
            }
            match (aim.objective, amount) {
                (Some(Objective::MostQuality), _) => aim.quality_floor = quality,
                (Some(Objective::Least(axis)), Some(least)) => {
                    if let Some(limit) = aim.limits.get_mut(axis) {
                        *limit = least;
                    }
                }
                _ => break,
            }
        }
        debug_assert!(
            found.is_some(),
            "the first objective has a plan, or it is the answer that there is none"
        );
        Ok(found.map_or(
            Answer::Unknown { bound: 0, steps: self.steps.saturating_sub(budget.left) },
            |planned| {
                Answer::Planned(Planned {
                    steps: self.steps.saturating_sub(budget.left),
                    ..planned
                })
            },
        ))
    }
}
