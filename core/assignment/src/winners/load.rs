//! The costs of a team as the search reads them: in small parts, missing ones as [`FAR`].

use super::solve::Winners;
use super::{BITS, FAR, PlanEntry, Slot, put};
use crate::{Combine, Cost, Team};
use cotama_units::memory::{MemoryError, enough};

impl<const N: usize> Winners<'_, N> {
    /// Takes over the numbers of a team.
    pub(super) fn load(&mut self, team: &Team<'_>) -> Result<(), MemoryError> {
        let memory = &mut self.memory;
        let tasks = team.tasks();
        enough("robots of the team's memory", team.robots(), N)?;
        enough("roles of the team's memory", team.roles(), memory.roles.len())?;
        enough("plans of the team's memory", team.plans(), memory.plans.len())?;
        enough("slots of the team's memory", tasks.len(), memory.slots.len())?;
        (self.tasks, self.robots) = (tasks.len(), team.robots());
        self.oracle.robots = team.robots();
        let used = u64::BITS.saturating_sub(team.most().leading_zeros());
        self.shift = BITS.saturating_sub(used).min(12);
        let (mut entry, mut role, mut step) = (0_usize, 0_usize, 0);
        let scaled = |it: u64, shift: u32| {
            debug_assert!(
                it.leading_zeros() > shift + u64::BITS - 1 - BITS,
                "costs fit their bits"
            );
            it.cast_signed().wrapping_shl(shift)
        };
        let parts = u64::from(team.denominator());
        for (number, task) in (0..tasks.len()).zip(tasks) {
            let skip = task.skip.map(|it| parts.wrapping_mul(it.get().into()));
            step = greatest_divisor(step, skip.unwrap_or(0));
            let must = skip.is_none();
            let skip = skip.map_or(FAR, |it| scaled(it, self.shift));
            put(memory.slots, number, Slot { undone: skip, skip, must, ..Slot::EMPTY });
            for (plan, it) in (0..task.plans.len()).zip(task.plans) {
                if it.roles.rows() > team.robots() {
                    continue;
                }
                let extra = parts.wrapping_mul(it.extra.into());
                step = greatest_divisor(step, extra);
                let own = PlanEntry {
                    task: number as u16,
                    number: plan as u16,
                    first: role as u32,
                    roles: it.roles.rows() as u32,
                    largest: task.combine == Combine::Max && it.roles.rows() > 1,
                    extra: scaled(extra, self.shift),
                };
                put(memory.plans, entry, own);
                entry = entry.wrapping_add(1);
                let weight = task.weight(team.denominator(), it.roles.rows());
                for costs in (0..it.roles.rows()).map(|at| it.roles.row(at)) {
                    let mut row = [FAR; N];
                    for (slot, cost) in row.iter_mut().zip(costs) {
                        let Some(cost) = cost.map(Cost::get) else { continue };
                        debug_assert!(weight <= parts, "a role counts once at most");
                        let cost = weight.wrapping_mul(cost.into());
                        step = greatest_divisor(step, cost);
                        *slot = scaled(cost, self.shift);
                    }
                    put(memory.roles, role, row);
                    role = role.wrapping_add(1);
                }
            }
        }
        debug_assert!(entry <= team.plans() && role <= team.roles(), "the memory suffices");
        (self.plans, self.roles) = (entry, role);
        self.step = scaled(step.max(1), self.shift);
        (self.keep, self.gap, self.nodes, self.contested) = (!0, 0, 0, 0);
        self.ceiling = scaled(team.most(), self.shift).wrapping_add(self.step);
        self.best = self.ceiling;
        Ok(())
    }
}

fn greatest_divisor(a: u64, b: u64) -> u64 {
    let (mut a, mut b) = (a, b);
    while let Some(rest) = a.checked_rem(b) {
        (a, b) = (b, rest);
    }
    a
}
