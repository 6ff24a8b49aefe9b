//! Memory of the search for all tasks on a heap.

use super::{Column, Level, Open, PlanEntry, Slot, Winners, WinnersMemory};
use crate::Team;
use alloc::vec::Vec;
use cotama_units::memory::at_least;

/// Memory on a heap for one search after another, for teams of up to `N` robots. It grows to what a
/// team needs; the answers are those of slices of the caller's.
///
/// ```
/// use cotama_core::team::winners::{Outcome, Workspace};
/// use cotama_core::team::{Combine, Cost, Costs, Plan, Task, Team};
///
/// let alone = [Cost::new(3), Cost::new(2)];
/// let plans = [Plan { roles: Costs::new(&alone, 2).unwrap(), extra: 0 }];
/// let tasks = [Task { skip: None, combine: Combine::Sum, plans: &plans }];
/// let team = Team::new(2, 1, &tasks).unwrap();
///
/// let mut workspace = Workspace::<2>::new();
/// let mut winners = workspace.winners(&team, 1_000);
/// assert_eq!(winners.solve(&team, 10_000).unwrap().outcome, Outcome::Optimal { cost: 2 });
/// assert!(winners.robots(0).eq([1]));
/// ```
#[derive(Clone, Debug)]
pub struct Workspace<const N: usize> {
    roles: Vec<[i64; N]>,
    plans: Vec<PlanEntry>,
    slots: Vec<Slot>,
    columns: Vec<Column>,
    open: Vec<Open>,
    levels: Vec<Level<N>>,
}

impl<const N: usize> Workspace<N> {
    /// No memory yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            roles: Vec::new(),
            plans: Vec::new(),
            slots: Vec::new(),
            columns: Vec::new(),
            open: Vec::new(),
            levels: Vec::new(),
        }
    }

    /// A search with memory for a team, which remembers up to `columns` coalitions at once; see
    /// [`WinnersMemory::columns`].
    pub fn winners(&mut self, team: &Team<'_>, columns: usize) -> Winners<'_, N> {
        let plans = team.tasks().iter().flat_map(|it| it.plans);
        let roles = plans.map(|it| it.roles.rows()).max().unwrap_or(0).clamp(1, N.max(1));
        let open = team.robots().saturating_mul(roles).saturating_add(1);
        Winners::new(WinnersMemory {
            roles: at_least(&mut self.roles, team.roles(), [0; N]),
            plans: at_least(&mut self.plans, team.plans(), PlanEntry::EMPTY),
            slots: at_least(&mut self.slots, team.tasks().len(), Slot::EMPTY),
            columns: at_least(&mut self.columns, columns, Column::EMPTY),
            open: at_least(&mut self.open, open, Open::EMPTY),
            levels: at_least(&mut self.levels, N.saturating_add(1), Level::EMPTY),
        })
    }
}

impl<const N: usize> Default for Workspace<N> {
    fn default() -> Self {
        Self::new()
    }
}
