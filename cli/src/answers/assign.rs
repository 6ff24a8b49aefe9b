//! The answer of `cotama assign`.

use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama assign`. Costs are in parts, `cost_denominator` of which make a unit, but
/// for prices and thresholds, which are in units as the costs of the instance.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct AssignAnswer {
    #[schemars(extend("const" = "cotama/assign/1"))]
    pub(crate) schema: &'static str,
    /// The name of the instance.
    pub(crate) name: String,
    pub(crate) status: AssignStatus,
    /// What the assignment costs; none where there is none.
    pub(crate) cost: Option<u64>,
    /// So many parts make a unit of cost.
    pub(crate) cost_denominator: u32,
    /// No assignment costs less; none where there is no assignment at all.
    pub(crate) lower_bound: Option<u64>,
    /// The tasks that are done, in the order of the instance.
    pub(crate) assignment: Vec<DoneRow>,
    /// Who competes for whom, where there is no assignment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) why_infeasible: Option<WhyInfeasible>,
    /// What proves the answer.
    pub(crate) certificate: Certificate,
    /// What greedy rounds come to, if that was asked; none where the team is too large for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) greedy: Option<GreedyRow>,
}

/// What is known.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum AssignStatus {
    /// No assignment costs less: it is proven.
    Optimal,
    /// Not all tasks that must be done can be: it is proven.
    Infeasible,
    /// A limit was reached.
    Unknown,
}

/// A task that is done.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct DoneRow {
    pub(crate) task: String,
    /// The plan; none of a task for one robot.
    pub(crate) plan: Option<String>,
    /// The robots, in the order of the plan's roles.
    pub(crate) robots: Vec<String>,
    /// What the task costs.
    pub(crate) cost: u64,
}

/// Tasks that must be done and cannot be staffed together.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct WhyInfeasible {
    pub(crate) tasks: Vec<String>,
    /// The robots that they compete for.
    pub(crate) robots: Vec<String>,
}

/// What proves an answer; all but a search can be added again by hand.
#[derive(Debug, JsonSchema, Serialize)]
#[serde(tag = "by", rename_all = "snake_case")]
pub(crate) enum Certificate {
    /// Each task costs at least the less of its `skip_cost` and of its cheapest robot with the
    /// price of that robot; all of these less all prices are the cost.
    Prices {
        /// One for each robot of the instance, in units.
        robot_prices: Vec<u64>,
    },
    /// Why no plan of the only task is better; one for each plan.
    Plans { plans: Vec<PlanRow> },
    /// The tasks of `why_infeasible` are more than the robots that can do any of them.
    Hall,
    /// A search left nothing that is better than the lower bound, or that serves all tasks.
    Search { steps: u64, nodes: u64 },
    /// Too large for a proof; the lower bound is what each task alone costs.
    Limit { limit: String },
}

/// Why a plan costs no less.
#[derive(Debug, Default, JsonSchema, Serialize)]
pub(crate) struct PlanRow {
    pub(crate) plan: String,
    /// What the task costs by this plan; none where it cannot be carried out.
    pub(crate) cost: Option<u64>,
    /// Of a sum or mean: one for each robot, in units. Each role costs at least its cheapest robot
    /// with the price of that robot; all of these less all prices are what the roles cost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) robot_prices: Option<Vec<u64>>,
    /// Of a maximum, in units: below it `roles` are more than `robots`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) threshold: Option<u32>,
    /// Roles that are more than the robots that can fill any of them, below the threshold if there
    /// is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) roles: Option<Vec<String>>,
    /// These robots.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) robots: Option<Vec<String>>,
}

/// What greedy rounds come to.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct GreedyRow {
    /// What the tasks that are done cost, and to leave the others undone.
    pub(crate) cost: u64,
    /// How many tasks that must be done are not; they cost nothing here.
    pub(crate) unserved: usize,
    pub(crate) rounds: usize,
}
