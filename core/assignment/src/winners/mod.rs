//! All tasks of a team at once: which are done, by which plan, and by whom.
//!
//! Choosing one coalition a task, no robot in two, is set packing over all 2ⁿ coalitions, which are
//! never listed as a whole:
//!
//! 1. *Bound* (`prices`): prices of robots; each task takes its cheapest coalition at these prices,
//!    which is an assignment (`oracle`), and what all pay less the prices is a bound. Its best
//!    value is that of the linear programme over all coalitions (A. M. Geoffrion, *Lagrangean
//!    relaxation for integer programming*, Mathematical Programming Study 2, 1974).
//! 2. *First solutions* (`first`): at these prices tasks choose one after another, and pairs of
//!    tasks exchange robots.
//! 3. *Coalitions within a reduced cost* (`columns`): a solution that is better by so much can only
//!    be made of coalitions that pay little more than the best of their task. These are listed.
//! 4. *Search* (`search`): branch and bound among these, with prices of its own. Either a solution
//!    comes out, which is the best, or the bound rises by that reduced cost, and the next one is
//!    larger.
//!
//! It is anytime: a step budget goes in, the best solution so far and a proven bound come out. The
//! same input gives the same answer.

mod answer;
mod columns;
mod first;
mod load;
mod oracle;
mod prices;
#[cfg(kani)]
pub mod proofs;
mod root;
mod search;
mod solve;
#[cfg(feature = "alloc")]
mod workspace;

use super::problem::RobotSet;
pub use answer::{Outcome, Solved, WinnersMemory};
pub use columns::Open;
pub use search::Level;
pub use solve::Winners;
#[cfg(feature = "alloc")]
pub use workspace::Workspace;

/// Cost of a missing entry; everything of [`LIMIT`] or more is missing.
const FAR: i64 = 1 << 60;
const LIMIT: i64 = 1 << 59;
/// A robot that must be taken is cheaper by this, more than all tasks cost.
const BIG: i64 = 1 << 51;
/// Costs are computed with in so small parts that all together take this many bits.
const BITS: u32 = 50;
/// The plan of a task that is left undone.
const NO_PLAN: u16 = u16::MAX;

/// One plan of one task; one element for each.
#[derive(Clone, Copy, Debug)]
pub struct PlanEntry {
    task: u16,
    /// Number among the plans of the task.
    number: u16,
    first: u32,
    roles: u32,
    /// The largest cost of a role counts, not the sum.
    largest: bool,
    extra: i64,
}

impl PlanEntry {
    /// Unused memory.
    pub const EMPTY: Self =
        Self { task: 0, number: 0, first: 0, roles: 0, largest: false, extra: 0 };

    fn rows<'r, const N: usize>(&self, all: &'r [[i64; N]]) -> &'r [[i64; N]] {
        let first = self.first as usize;
        debug_assert!(first + self.roles as usize <= all.len(), "the roles of a plan are loaded");
        all.get(first..first.saturating_add(self.roles as usize)).unwrap_or(&[])
    }

    const fn column(&self, set: RobotSet, cost: i64) -> Column {
        Column { set, cost, task: self.task, plan: self.number }
    }
}

/// The plans of a task among all, which are sorted by tasks.
fn plans_of(all: &[PlanEntry], task: usize) -> &[PlanEntry] {
    debug_assert!(all.is_sorted_by_key(|it| it.task), "sorted by tasks");
    let first = all.partition_point(|it| usize::from(it.task) < task);
    let end = all.partition_point(|it| usize::from(it.task) <= task);
    all.get(first..end).unwrap_or(&[])
}

/// The state of one task; one element for each.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    /// Cost of leaving the task undone, and its present value.
    undone: i64,
    skip: i64,
    /// Whether the task must be done.
    must: bool,
    /// Whether the task is left undone, so that its plans do not matter.
    idle: bool,
    /// Whether the task is one of those that cannot be staffed together.
    conflict: bool,
    /// Robots and plan of the task in the best solution.
    chosen: RobotSet,
    plan: u16,
    /// Robots and plan of the task in a solution under work.
    draft: RobotSet,
    draft_plan: u16,
    draft_cost: i64,
    rank: i64,
    /// The least it pays at the current prices, and the column that is.
    least: i64,
    column: u32,
    /// The least payment without a robot, and the robots it cannot do without.
    without: i64,
    common: RobotSet,
}

impl Slot {
    /// Unused memory.
    pub const EMPTY: Self = Self {
        undone: 0,
        skip: 0,
        must: false,
        idle: false,
        conflict: false,
        chosen: 0,
        plan: NO_PLAN,
        draft: 0,
        draft_plan: NO_PLAN,
        draft_cost: 0,
        rank: 0,
        least: 0,
        column: 0,
        without: 0,
        common: 0,
    };
}

/// A coalition that does a task by a plan, or none that leaves it undone; as many as are to be
/// remembered at once.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    set: RobotSet,
    cost: i64,
    task: u16,
    plan: u16,
}

impl Column {
    /// Unused memory.
    pub const EMPTY: Self = Self { set: 0, cost: 0, task: 0, plan: 0 };

    /// Returns the cost with the prices of its robots.
    #[inline]
    fn value<const N: usize>(&self, prices: &[i64; N]) -> i64 {
        bits(self.set).fold(self.cost, |sum, it| sum.wrapping_add(at(prices, it)))
    }
}

/// A number of steps that may still be taken: about as many as roles are looked at, and
/// more where tasks are. No step takes longer the more tasks there are.
#[derive(Clone, Copy, Debug)]
struct Budget {
    left: u64,
}

impl Budget {
    fn take(&mut self, steps: u64) -> Option<()> {
        self.left = self.left.checked_sub(steps)?;
        Some(())
    }
}

/// The elements of a set.
#[inline]
fn bits(set: RobotSet) -> impl Iterator<Item = usize> {
    let (mut low, mut high) = (set as u64, (set >> 64) as u64);
    core::iter::from_fn(move || {
        if low != 0 {
            let bit = low.trailing_zeros() as usize;
            low &= low.wrapping_sub(1);
            Some(bit)
        } else if high != 0 {
            let bit = high.trailing_zeros() as usize;
            high &= high.wrapping_sub(1);
            Some(bit.wrapping_add(64))
        } else {
            None
        }
    })
}

/// Whether no robot is in two of these sets.
fn disjoint(sets: impl Iterator<Item = RobotSet>) -> bool {
    let mut taken = 0;
    for set in sets {
        if taken & set != 0 {
            return false;
        }
        taken |= set;
    }
    true
}

/// An element of a list.
#[inline]
fn at<T: Copy + Default>(list: &[T], place: usize) -> T {
    debug_assert!(place < list.len(), "a place of the list");
    list.get(place).copied().unwrap_or_default()
}

/// Writes an element of a list.
#[inline]
fn put<T>(list: &mut [T], place: usize, value: T) {
    debug_assert!(place < list.len(), "a place of the list");
    if let Some(it) = list.get_mut(place) {
        *it = value;
    }
}
