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
    /// Figures of a team at work; none of other instances.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) team: Option<TeamRow>,
}

/// Figures of a team at its start.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TeamRow {
    /// The performance of the assignment (2.7): of the utility of all tasks what is left when the
    /// cost is taken away, in thousandths, rounded down; none without an assignment or utility.
    pub(crate) performance_permille: Option<i64>,
    /// How different the robots are (3.5): from 0, all equal, to 1, nothing shared; none of one.
    pub(crate) heterogeneity: Option<Fraction>,
    /// At least so much of the largest possible reward is kept by greedy rounds (3.5.3), while
    /// enough free capable coalitions remain; none where no task is for several robots, where a
    /// coalition costs as much as its task yields, or without `pruning`.
    pub(crate) bound: Option<Fraction>,
    /// Coalitions that can be passed over before any bid (3.4.2); none where these are more than
    /// 100,000.
    pub(crate) pruning: Option<PruningRow>,
}

/// An exact fraction.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Fraction {
    /// Numerator and denominator in lowest terms, as `1/3`.
    pub(crate) exact: String,
    /// In thousandths, rounded down.
    pub(crate) permille: u64,
}

/// What conditions on coalitions save: all coalitions of as many robots as a plan has roles, over
/// the plans of all tasks for several robots.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PruningRow {
    pub(crate) coalitions: u64,
    /// Steps of all their role assignments: z³ each for z robots.
    pub(crate) steps: u64,
    pub(crate) conditions: Vec<PruningCondition>,
}

/// A condition that a coalition must meet to be capable.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PruningCondition {
    /// `cap1`: all robots together could fill each role; `cap2`: each role has a robot that can;
    /// `cap3`: each has a robot of its own.
    pub(crate) name: &'static str,
    /// Coalitions that meet it.
    pub(crate) passed: u64,
    /// Steps with the condition first: 2z, z² and z³ for the condition, and z³ for each coalition
    /// that meets it. The condition pays where these are fewer than without.
    pub(crate) steps: u64,
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
