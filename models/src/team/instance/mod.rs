//! Teams and their tasks from files: `cotama-team-assignment/1`, in JSON; and those of a team at
//! work ([`scenario`](super::scenario)), as it starts.
//!
//! [`Instance::parse`] reads a file and reports every error at once, each with its place and the
//! path of its field; what it returns is complete. [`Instance::solve`] says who does what at the
//! least cost, and what proves it.

mod check;
mod coalition;
mod context;
mod draft;
mod joint;
mod opening;
mod reader;
mod single;
mod solve;
mod staffed;

pub use draft::{FORMAT, MAX_COST, MAX_INSTANCE_ENTRIES};
pub use solve::{Assignment, Done, Greedy, PlanProof, Proof, Reason, Verdict};

use cotama_core::team::{Combine, Cost, Costs, Plan, Task, Team, TeamError};

/// The kind of tasks of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Each task needs one robot.
    Single,
    /// One task of several robots; the mean of its roles counts.
    CoalitionMean,
    /// One task of several robots; the largest cost of its roles counts.
    CoalitionMax,
    /// Any tasks, all at once.
    Simultaneous,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 4] =
        [Self::Single, Self::CoalitionMean, Self::CoalitionMax, Self::Simultaneous];

    /// Returns the name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::CoalitionMean => "coalition-mean",
            Self::CoalitionMax => "coalition-max",
            Self::Simultaneous => "simultaneous",
        }
    }
}

/// A team and its tasks, complete: each list of costs has one entry a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Instance {
    /// Name of the instance.
    pub name: String,
    /// Kind of its tasks.
    pub kind: Kind,
    /// All costs of answers are counted in parts, so many of which make a unit.
    pub denominator: u32,
    /// The names of the robots.
    pub robots: Vec<String>,
    /// The tasks.
    pub tasks: Vec<InstanceTask>,
}

/// A task of an instance.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct InstanceTask {
    /// Name of the task.
    pub name: String,
    /// Cost of leaving the task undone; `None` where it must be done.
    pub skip: Option<Cost>,
    /// How the costs of roles become one.
    pub combine: Combine,
    /// Whether the plans have names and roles; else there is one plan with one role, both without a
    /// name.
    pub is_for_several: bool,
    /// The plans, at least one.
    pub plans: Vec<InstancePlan>,
}

/// A plan of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct InstancePlan {
    /// Name of the plan; empty where the task needs one robot.
    pub name: String,
    /// The yield that the plan lacks to the best plan of the task.
    pub extra: u32,
    /// The names of its roles, at least one.
    pub roles: Vec<String>,
    /// Cost of each robot in each role, role after role.
    pub costs: Vec<Option<Cost>>,
}

impl InstancePlan {
    /// Returns the cost of each robot in each role: roles are rows, robots are columns. None where
    /// the costs are not as many as roles times robots, which no file can say.
    pub fn table(&self) -> Option<Costs<'_>> {
        Costs::new(&self.costs, self.costs.len().checked_div(self.roles.len())?)
    }
}

impl Instance {
    /// Runs something on the instance as `cotama-core` reads it.
    ///
    /// # Errors
    /// [`TeamError`] where it is larger than all tasks at once can be: 128 robots, for instance.
    pub fn with_team<R>(&self, act: impl FnOnce(&Team<'_>) -> R) -> Result<R, TeamError> {
        let mut plans = Vec::with_capacity(self.tasks.len());
        for (task, it) in self.tasks.iter().enumerate() {
            let mut own = Vec::with_capacity(it.plans.len());
            for (plan, it) in it.plans.iter().enumerate() {
                let roles = it.table().ok_or(TeamError::Robots { task, plan })?;
                own.push(Plan { roles, extra: it.extra });
            }
            plans.push(own);
        }
        let task = |(it, plans)| {
            let (it, plans): (&InstanceTask, &Vec<_>) = (it, plans);
            Task { skip: it.skip, combine: it.combine, plans }
        };
        let tasks: Vec<_> = self.tasks.iter().zip(&plans).map(task).collect();
        Ok(act(&Team::new(self.robots.len(), self.denominator, &tasks)?))
    }

    /// Returns the cost of a task that is done, in parts; `None` where a robot is not capable of
    /// its role.
    pub fn cost_of(&self, done: &Done) -> Option<u64> {
        let task = self.tasks.get(done.task)?;
        let plan = task.plans.get(done.plan)?;
        let roles = plan.table()?;
        let costs = done.robots.iter().enumerate().map(|(role, it)| roles.cost(role, *it));
        let costs = costs.collect::<Option<Vec<_>>>()?;
        let of = Task { skip: task.skip, combine: task.combine, plans: &[] };
        let plan = Plan { roles, extra: plan.extra };
        Some(of.cost(&plan, self.denominator, costs.into_iter()))
    }
}
