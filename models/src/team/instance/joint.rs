//! All tasks at once: a search within a budget.

use super::Instance;
use super::solve::{Assignment, Done, Proof, Reason, Verdict};
use cotama_core::allocation::MemoryError;
use cotama_core::team::winners::{Outcome, Workspace};
use cotama_core::team::{Combine, Cost, Team};

/// Coalitions that are remembered at once: so many a task, at least and at most so many in all.
const COLUMNS: usize = 8_000;
const LEAST: usize = 1 << 13;
const MOST: usize = 1 << 19;

impl Instance {
    pub(super) fn solve_joint(&self, steps: u64) -> Result<Assignment, MemoryError> {
        let solved = self.with_team(|team| match team.robots() {
            0..=16 => self.search::<16>(team, steps),
            17..=64 => self.search::<64>(team, steps),
            _ => self.search::<{ Team::MAX_ROBOTS }>(team, steps),
        });
        solved.unwrap_or_else(|error| Ok(self.too_large(error.to_string())))
    }

    fn search<const N: usize>(
        &self,
        team: &Team<'_>,
        steps: u64,
    ) -> Result<Assignment, MemoryError> {
        let columns = self.tasks.len().saturating_mul(COLUMNS).clamp(LEAST, MOST);
        let mut workspace = Workspace::<N>::new();
        let mut joint = workspace.winners(team, columns);
        let solved = joint.solve(team, steps)?;
        let proof = Proof::Search { steps: solved.steps, nodes: solved.nodes };
        let verdict = match solved.outcome {
            Outcome::Optimal { cost } => Verdict::Optimal { cost },
            Outcome::Unknown { cost, bound } => Verdict::Unknown { cost, bound },
            Outcome::Infeasible { robots } => {
                let tasks = (0..self.tasks.len()).filter(|it| joint.in_conflict(*it)).collect();
                let has = |it: &usize| robots & 1_u128.wrapping_shl(*it as u32) != 0;
                let robots = (0..self.robots.len()).filter(has).collect();
                let verdict = Verdict::Infeasible(Reason { tasks, robots });
                return Ok(Assignment { verdict, done: vec![], proof });
            }
        };
        let mut done = vec![];
        if !matches!(verdict, Verdict::Unknown { cost: None, .. }) {
            for task in 0..self.tasks.len() {
                if let Some((plan, _)) = joint.chosen(task) {
                    done.push(Done { task, plan, robots: joint.robots(task).collect() });
                }
            }
        }
        Ok(Assignment { verdict, done, proof })
    }

    /// Returns the answer for an instance that is too large: the sum of the least costs of each
    /// task alone as a bound.
    pub(super) fn too_large(&self, limit: String) -> Assignment {
        let parts = u64::from(self.denominator);
        let bound = self.tasks.iter().map(|task| {
            let skip = task.skip.map_or(u64::MAX, |it| parts.saturating_mul(it.get().into()));
            let plans = task.plans.iter().filter_map(|plan| {
                let robots = self.robots.len().max(1);
                let cheapest = plan.costs.chunks(robots).map(|row| row.iter().flatten().min());
                let costs = cheapest.map(|it| it.copied().map(Cost::get).map(u64::from));
                let costs = costs.collect::<Option<Vec<_>>>()?;
                let (sum, most) = (costs.iter().sum::<u64>(), costs.iter().max().copied());
                let joint = match task.combine {
                    Combine::Sum => parts.saturating_mul(sum),
                    Combine::Mean => (parts / plan.roles.len().max(1) as u64).saturating_mul(sum),
                    Combine::Max => parts.saturating_mul(most.unwrap_or(0)),
                };
                Some(joint.saturating_add(parts.saturating_mul(plan.extra.into())))
            });
            plans.min().unwrap_or(u64::MAX).min(skip)
        });
        // A task that nobody can do, and must be done, costs nothing here: a bound may be low.
        let bound = bound.filter(|it| *it < u64::MAX).fold(0, u64::saturating_add);
        let verdict = Verdict::Unknown { cost: None, bound };
        Assignment { verdict, done: vec![], proof: Proof::TooLarge { limit } }
    }
}
