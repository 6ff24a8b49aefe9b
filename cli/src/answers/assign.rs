//! The answer of `cotama assign`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama assign`. Costs are in parts, `cost_denominator` of which make a unit, but
/// for prices and thresholds, which are in units as the costs of the instance.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AssignAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/assign/1")))]
    pub(crate) schema: &'static str,
    /// The name of the instance.
    pub(crate) name: String,
    pub(crate) status: AssignStatus,
    /// Cost of the assignment; none where there is none.
    pub(crate) cost: Option<u64>,
    /// So many parts make a unit of cost.
    pub(crate) cost_denominator: u32,
    /// No assignment costs less; none where there is no assignment at all.
    pub(crate) lower_bound: Option<u64>,
    /// The tasks that are done, in the order of the instance.
    pub(crate) assignment: Vec<DoneRow>,
    /// Tasks and robots in conflict, where there is no assignment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) why_infeasible: Option<WhyInfeasible>,
    /// Proof of the answer.
    pub(crate) certificate: Certificate,
    /// Result of greedy rounds, if that was asked; none where the team is too large for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) greedy: Option<GreedyRow>,
}

/// Status of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
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
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DoneRow {
    pub(crate) task: String,
    /// The plan; none of a task for one robot.
    pub(crate) plan: Option<String>,
    /// The robots, in the order of the plan's roles.
    pub(crate) robots: Vec<String>,
    /// Cost of the task.
    pub(crate) cost: u64,
}

/// Tasks that must be done and cannot be staffed together.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct WhyInfeasible {
    pub(crate) tasks: Vec<String>,
    /// The robots that they compete for.
    pub(crate) robots: Vec<String>,
}

/// A proof of an answer; all but a search can be added up again by hand.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(tag = "by", rename_all = "snake_case")]
pub(crate) enum Certificate {
    /// Each task costs at least the less of its `skip_cost` and of its cheapest robot with the
    /// price of that robot; all of these less all prices are the cost.
    Prices {
        /// One for each robot of the instance, in units.
        robot_prices: Vec<u64>,
    },
    /// Why no plan of the only task is better; one for each plan.
    Plans { plans: Vec<ProofRow> },
    /// The tasks of `why_infeasible` are more than the robots that can do any of them.
    Hall,
    /// A search left nothing that is better than the lower bound, or that serves all tasks.
    Search { steps: u64, nodes: u64 },
    /// Too large for a proof; the lower bound is what each task alone costs.
    Limit { limit: String },
}

/// Why a plan costs no less.
#[derive(Debug, Default, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ProofRow {
    pub(crate) plan: String,
    /// Cost of the task by this plan; none where it cannot be carried out.
    pub(crate) cost: Option<u64>,
    /// For a sum or mean: one price for each robot, in units. Each role costs at least its cheapest
    /// robot with the price of that robot; all of these less all prices are what the roles cost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) robot_prices: Option<Vec<u64>>,
    /// For a maximum, in units: with all costs below this, `robots` are too few for `roles`.
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

/// The result of greedy rounds.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct GreedyRow {
    /// Cost of the tasks that are done, and of leaving the others undone.
    pub(crate) cost: u64,
    /// How many tasks that must be done are not; they cost nothing here.
    pub(crate) unserved: usize,
    pub(crate) rounds: usize,
}
