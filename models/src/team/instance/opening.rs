//! The tasks of a team at work as an instance.

use super::{Instance, InstancePlan, InstanceTask, Kind};
use crate::team::scenario::{PlanSpec, Scenario, TaskSpec, common_denominator};
use cotama_core::team::{Combine, Cost};

impl From<&Scenario> for Instance {
    /// All tasks of a team at work as they would be awarded if they were known at its start: each
    /// robot is free, at its place, and bids for each role that it can fill
    /// ([`Scenario::bid`]). Costs are ms of a robot's time.
    ///
    /// ```
    /// use cotama_models::team::{instance::Instance, scenario};
    /// let service = scenario::service().unwrap();
    /// let instance = Instance::from(&service);
    /// assert_eq!((instance.robots.len(), instance.tasks.len()), (4, 2));
    /// let found = instance.solve(1_000).unwrap();
    /// assert_eq!(found.done.len(), 2);
    /// ```
    fn from(scenario: &Scenario) -> Self {
        // One robot a task, whose costs say all: an assignment.
        let alone = |it: &TaskSpec| match it.plans.as_slice() {
            [plan] => plan.roles.len() == 1 && plan.extra_ms == 0,
            _ => false,
        };
        let kind = if scenario.tasks.iter().all(alone) { Kind::Single } else { Kind::Simultaneous };
        let names = |it: &str| if kind == Kind::Single { String::new() } else { it.to_owned() };
        let plan = |task: usize, it: &PlanSpec| {
            let costs = it.roles.iter().flat_map(|role| {
                let bids = (0..scenario.robots.len()).map(move |it| scenario.bid(it, task, role));
                bids.map(|it| it.and_then(Cost::new))
            });
            InstancePlan {
                name: names(&it.name),
                extra: it.extra_ms,
                roles: it.roles.iter().map(|it| names(&it.name)).collect(),
                costs: costs.collect(),
            }
        };
        let task = |(number, it): (usize, &TaskSpec)| InstanceTask {
            name: it.name.clone(),
            skip: Cost::new(it.utility_ms),
            combine: if kind == Kind::Single { Combine::Sum } else { it.combine },
            is_for_several: kind != Kind::Single,
            plans: it.plans.iter().map(|it| plan(number, it)).collect(),
        };
        let tasks: Vec<_> = scenario.tasks.iter().enumerate().map(task).collect();
        let means = tasks.iter().filter(|it| it.combine == Combine::Mean);
        let sizes = means.flat_map(|it| &it.plans).map(|it| it.roles.len() as u32);
        Self {
            name: scenario.name.clone(),
            kind,
            denominator: common_denominator(sizes),
            robots: scenario.robots.iter().map(|it| it.name.clone()).collect(),
            tasks,
        }
    }
}
