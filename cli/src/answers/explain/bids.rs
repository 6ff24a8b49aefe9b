//! The answer of `cotama explain` of a team.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama explain` of a team: why bids are what they are as it starts, and what
/// comes of them for each task alone. Times are ms of a robot.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BidsAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/explain-team/1")))]
    pub(crate) schema: &'static str,
    /// The name of the team.
    pub(crate) team: String,
    /// For each task that is asked for, its bids and the coalitions that they make.
    pub(crate) because: Vec<ContestRow>,
}

/// The contest for a task.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ContestRow {
    pub(crate) task: String,
    /// The places of its object and of its goal.
    pub(crate) from: String,
    pub(crate) to: String,
    /// Cost of leaving it undone.
    pub(crate) skip_ms: u32,
    /// How the costs of roles become one: `sum`, `mean` or `max`.
    pub(crate) combine: &'static str,
    /// Costs of coalitions are in parts, so many of which make a ms.
    pub(crate) cost_denominator: u32,
    pub(crate) plans: Vec<BidPlanRow>,
    /// The best coalition, whether or not the task is worth its cost; none where no plan can be
    /// carried out.
    pub(crate) best: Option<OfferRow>,
    /// Says that it costs less than to leave the task undone.
    pub(crate) worth_it: bool,
    /// The cost that each of its robots would pledge not to exceed (3.15); none without a
    /// coalition, or where it hangs on what brokers happen to bid.
    pub(crate) pledge_ms: Option<u64>,
    /// The best that has another plan or other robots.
    pub(crate) second: Option<OfferRow>,
    /// Cost beyond that of the best.
    pub(crate) second_costs_more: Option<u64>,
    /// Cost of the task without each robot of the best coalition.
    pub(crate) without: Vec<WithoutRow>,
}

/// A coalition.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct OfferRow {
    pub(crate) plan: String,
    /// In the order of the plan's roles.
    pub(crate) robots: Vec<String>,
    /// In parts of a ms.
    pub(crate) cost: u64,
}

/// The task without a robot.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct WithoutRow {
    pub(crate) robot: String,
    /// In parts of a ms; none where nobody can do it then.
    pub(crate) cost: Option<u64>,
    /// Cost beyond that of the best, in parts of a ms.
    pub(crate) more: Option<u64>,
}

/// A plan with its bids.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BidPlanRow {
    pub(crate) plan: String,
    /// Yield that it lacks to the best plan of the task.
    pub(crate) extra_ms: u32,
    /// The best coalition for it.
    pub(crate) best: Option<OfferRow>,
    pub(crate) roles: Vec<BidRoleRow>,
}

/// A role with its bids.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BidRoleRow {
    pub(crate) role: String,
    /// One for each robot.
    pub(crate) bids: Vec<BidRow>,
}

/// A bid of a robot, or why there is none.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BidRow {
    pub(crate) robot: String,
    /// The bid, failures counted in (3.13): the sum of `counts` and of `failures_ms`; none where
    /// the robot cannot.
    pub(crate) bid_ms: Option<u32>,
    /// Skills that it lacks: of each entry, as `grasp | claw`, it would need one.
    pub(crate) lacks: Vec<String>,
    /// Why else it does not bid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) why_not: Option<&'static str>,
    /// Times that it counts; none where there is no bid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) counts: Option<BidPartsRow>,
    /// Mean addition of failures, rounded up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) failures_ms: Option<u64>,
    /// Probability that no action fails, in thousandths, rounded down.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) success_permille: Option<u32>,
    /// The actions of the role, in their order.
    pub(crate) actions: Vec<BidActionRow>,
}

/// The times of a bid when nothing fails.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BidPartsRow {
    /// Ways to where it takes, and from there to where it gives, in mm.
    pub(crate) ways_mm: [u64; 2],
    /// Times of these drives, planning before each included.
    pub(crate) drives_ms: [u64; 2],
    /// Delays of these drives on crowded ways, as bids take them to be.
    pub(crate) delays_ms: [u64; 2],
    /// Time of the decisional component between the parts of the task.
    pub(crate) rounds_ms: u64,
    pub(crate) take_ms: u64,
    pub(crate) give_ms: u64,
}

/// An action of a bid.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BidActionRow {
    /// Skills that it uses: of each choice the most reliable one (3.11, 3.12).
    pub(crate) uses: Vec<String>,
    pub(crate) cost_ms: u32,
    /// Probability that it does not fail, in thousandths, rounded down.
    pub(crate) success_permille: u32,
    /// The mean cost to repeat what is lost when it fails, rounded up.
    pub(crate) repeated_ms: u64,
    /// This times the probability that it fails, rounded up.
    pub(crate) failures_ms: u64,
}
