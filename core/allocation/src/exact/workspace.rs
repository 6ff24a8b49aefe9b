//! Memory of the exact allocator on a heap.

use super::{Exact, Item, Objective, Seen, Stage};
use crate::problem::Problem;
use alloc::vec::Vec;
use cotama_units::memory::at_least;

/// Memory on a heap for one search after another. It grows to what a problem needs; the answers
/// are those of slices of the caller's.
///
/// ```
/// use cotama_core::allocation::{Allocator, Answer};
/// use cotama_core::exact::{Objective, Workspace};
/// use cotama_core::problem::{Candidate, Problem};
///
/// let c = |energy, quality| Candidate { cost: [energy], quality, id: 0 };
/// let ways = [c(2, 1), c(4, 3), c(9, 4)];
/// let activities = [&ways[..]; 3];
/// let problem = Problem::new(&activities, [15], [0]).unwrap();
///
/// let (mut workspace, mut plan) = (Workspace::new(), [0; 3]);
/// let mut exact = workspace.exact(&problem, &[Objective::MostQuality], 10_000, 64);
/// let Ok(Answer::Planned(planned)) = exact.allocate(&problem, &mut plan) else { panic!() };
/// assert_eq!((plan, planned.quality, planned.optimal), ([1, 1, 1], 9, true));
/// ```
#[derive(Clone, Debug)]
pub struct Workspace<const A: usize> {
    items: Vec<Item<A>>,
    stages: Vec<Stage<A>>,
    seen: Vec<Seen<A>>,
}

impl<const A: usize> Workspace<A> {
    /// No memory yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { items: Vec::new(), stages: Vec::new(), seen: Vec::new() }
    }

    /// An allocator for a problem, as [`Exact::new`] makes it, which remembers up to `nodes` nodes;
    /// see [`Exact::with_memory`]. It has memory for problems of as many candidates and activities.
    pub fn exact<'m>(
        &'m mut self,
        problem: &Problem<'_, A>,
        objectives: &'m [Objective],
        steps: u64,
        nodes: usize,
    ) -> Exact<'m, A> {
        let activities = problem.activities();
        let candidates = activities.iter().map(|it| it.len()).fold(0, usize::saturating_add);
        let items = at_least(&mut self.items, candidates, Item::EMPTY);
        let stages = at_least(&mut self.stages, activities.len(), Stage::EMPTY);
        let seen = at_least(&mut self.seen, nodes, Seen::EMPTY);
        Exact::new(objectives, steps, items, stages).with_memory(seen)
    }
}

impl<const A: usize> Default for Workspace<A> {
    fn default() -> Self {
        Self::new()
    }
}
