//! The costs of a team as the search reads them: in small parts, missing ones as [`FAR`].

use super::solve::Joint;
use super::{BITS, FAR, Slot, Way, put};
use crate::allocation::{MemoryError, enough};
use crate::team::{Combine, Cost, Team};

impl<const N: usize> Joint<'_, N> {
    /// Takes over the numbers of a team.
    pub(super) fn load(&mut self, team: &Team<'_>) -> Result<(), MemoryError> {
        let memory = &mut self.memory;
        let tasks = team.tasks();
        enough("robots of the team's memory", team.robots(), N)?;
        enough("roles of the team's memory", team.roles(), memory.roles.len())?;
        enough("ways of the team's memory", team.plans(), memory.ways.len())?;
        enough("slots of the team's memory", tasks.len(), memory.slots.len())?;
        (self.tasks, self.robots) = (tasks.len(), team.robots());
        self.oracle.robots = team.robots();
        let used = u64::BITS - team.most().leading_zeros();
        self.shift = BITS.saturating_sub(used).min(12);
        let (mut way, mut role, mut step) = (0, 0, 0);
        let parts = u64::from(team.denominator());
        for (number, task) in tasks.iter().enumerate() {
            let skip = task.skip.map(|it| parts * u64::from(it.get()));
            step = greatest_divisor(step, skip.unwrap_or(0));
            let must = skip.is_none();
            let skip = skip.map_or(FAR, |it| it.cast_signed() << self.shift);
            put(memory.slots, number, Slot { undone: skip, skip, must, ..Slot::EMPTY });
            for (plan, it) in task.plans.iter().enumerate() {
                if it.roles.rows() > team.robots() {
                    continue;
                }
                let extra = parts * u64::from(it.extra);
                step = greatest_divisor(step, extra);
                let own = Way {
                    task: number as u16,
                    plan: plan as u16,
                    first: role as u32,
                    roles: it.roles.rows() as u32,
                    largest: task.combine == Combine::Max && it.roles.rows() > 1,
                    extra: extra.cast_signed() << self.shift,
                };
                put(memory.ways, way, own);
                way += 1;
                let weight = task.weight(team.denominator(), it.roles.rows());
                for costs in (0..it.roles.rows()).map(|at| it.roles.row(at)) {
                    let mut row = [FAR; N];
                    for (slot, cost) in row.iter_mut().zip(costs) {
                        let Some(cost) = cost.map(Cost::get) else { continue };
                        let cost = weight * u64::from(cost);
                        step = greatest_divisor(step, cost);
                        *slot = cost.cast_signed() << self.shift;
                    }
                    put(memory.roles, role, row);
                    role += 1;
                }
            }
        }
        (self.plans, self.roles) = (way, role);
        self.step = step.max(1).cast_signed() << self.shift;
        (self.keep, self.gap, self.nodes, self.contested) = (!0, 0, 0, 0);
        self.ceiling = (team.most().cast_signed() << self.shift) + self.step;
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
