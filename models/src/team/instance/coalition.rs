//! One task of several robots: each plan is one assignment.

use super::single::{Read, assigned};
use super::solve::{Assignment, Done, PlanProof, Proof, Reason, Verdict};
use super::{Instance, InstancePlan, InstanceTask};
use cotama_core::allocation::MemoryError;
use cotama_core::team::{AssignmentError, Combine, Cost, Costs, Memory, Plan, Task, bottleneck};

/// A plan with its robots, or without any, and why it costs no less.
struct Staffed {
    robots: Option<Vec<usize>>,
    proof: PlanProof,
}

impl Instance {
    /// Each plan is staffed best, and the least cost is taken; of equal ones the plan with the
    /// fewest roles, then the first.
    pub(super) fn solve_coalition(&self) -> Result<Assignment, MemoryError> {
        let Some(task) = self.tasks.first() else { return self.solve_single() };
        let mut best: Option<(u64, usize, Done)> = None;
        let mut proofs = vec![];
        for (number, plan) in task.plans.iter().enumerate() {
            let staffed = self.staff(task, plan)?;
            if let (Some(robots), Some(cost)) = (staffed.robots, staffed.proof.cost()) {
                let key = (cost, plan.roles.len());
                if best.as_ref().is_none_or(|it| key < (it.0, it.1)) {
                    best = Some((key.0, key.1, Done { task: 0, plan: number, robots }));
                }
            }
            proofs.push(staffed.proof);
        }
        let parts = u64::from(self.denominator);
        let skip = task.skip.map(|it| parts.saturating_mul(it.get().into()));
        let (cost, done) = match (best, skip) {
            (Some((cost, _, _)), Some(skip)) if skip < cost => (skip, vec![]),
            (Some((cost, _, done)), _) => (cost, vec![done]),
            (None, Some(skip)) => (skip, vec![]),
            (None, None) => {
                let reason = Reason { tasks: vec![0], robots: self.capable(&[0]) };
                let verdict = Verdict::Infeasible(reason);
                return Ok(Assignment { verdict, done: vec![], proof: Proof::Plans(proofs) });
            }
        };
        let verdict = Verdict::Optimal { cost };
        Ok(Assignment { verdict, done, proof: Proof::Plans(proofs) })
    }

    /// Gives the roles of a plan to robots.
    fn staff(&self, task: &InstanceTask, plan: &InstancePlan) -> Result<Staffed, MemoryError> {
        let lacks = MemoryError { what: "roles of a plan", needed: plan.roles.len(), given: 0 };
        let table = plan.table().ok_or(lacks)?;
        if task.combine != Combine::Max {
            return assigned(&table, |costs, result, memory| {
                self.staffed(task, plan, costs, result.map(|_| None), memory)
            })?;
        }
        let (rows, columns) = (table.rows(), table.columns());
        let (mut words, mut amounts) = (
            vec![0; Memory::<i64>::words(rows, columns)],
            vec![0; Memory::<i64>::amounts(columns)],
        );
        let mut memory = Memory::<i64>::new(rows, columns, &mut words, &mut amounts)?;
        let result = bottleneck(&table, &mut memory).map(|it| it.largest);
        self.staffed(task, plan, &table, result, &memory)
    }

    /// Returns the outcome of a plan; with the largest cost where that one counts.
    fn staffed(
        &self,
        task: &InstanceTask,
        plan: &InstancePlan,
        table: &Costs<'_>,
        result: Result<Option<Cost>, AssignmentError>,
        memory: &dyn Read,
    ) -> Result<Staffed, MemoryError> {
        let conflict = || (0..plan.roles.len()).filter(|it| memory.in_conflict(*it));
        let conflict: Vec<_> = conflict().collect();
        let capable = |table: &Costs<'_>| {
            let some = |robot: &usize| conflict.iter().any(|it| table.cost(*it, *robot).is_some());
            (0..self.robots.len()).filter(some).collect::<Vec<_>>()
        };
        let largest = match result {
            Ok(largest) => largest,
            Err(AssignmentError::Infeasible { .. }) => {
                let robots = capable(table);
                let proof = PlanProof::Impossible { roles: conflict, robots };
                return Ok(Staffed { robots: None, proof });
            }
            Err(AssignmentError::Memory(error)) => return Err(error),
            Err(error @ AssignmentError::TooLarge) => {
                debug_assert!(false, "{error}: 64 bits suffice for costs to 10^9");
                let lacks = MemoryError { what: "amounts", needed: usize::MAX, given: 0 };
                return Err(lacks);
            }
        };
        let robots: Vec<_> = (0..plan.roles.len()).filter_map(|it| memory.column(it)).collect();
        let costs = robots.iter().enumerate().filter_map(|(role, it)| table.cost(role, *it));
        let own = Plan { roles: *table, extra: plan.extra };
        let of = Task { skip: task.skip, combine: task.combine, plans: &[] };
        let cost = of.cost(&own, self.denominator, costs);
        let proof = if let Some(it) = largest {
            let robots = capable(&table.below(it));
            PlanProof::Threshold { cost, largest: it.get(), roles: conflict, robots }
        } else {
            let price = |robot| memory.price(robot).unsigned_abs();
            PlanProof::Prices { cost, prices: (0..self.robots.len()).map(price).collect() }
        };
        Ok(Staffed { robots: Some(robots), proof })
    }
}

impl PlanProof {
    /// Returns the cost of the task by this plan, in parts; `None` where it cannot be carried out.
    pub const fn cost(&self) -> Option<u64> {
        match self {
            Self::Prices { cost, .. } | Self::Threshold { cost, .. } => Some(*cost),
            Self::Impossible { .. } => None,
        }
    }
}
