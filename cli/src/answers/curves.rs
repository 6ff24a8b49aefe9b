//! The answer of `cotama assign --curves`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama assign --curves`: how the work for one task, with a plan for each number
/// of robots, grows with the team. To assign z roles to z robots counts as z³ steps.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CurvesAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/assign-curves/1")))]
    pub(crate) schema: &'static str,
    /// All robots are capable (Fig. 3.4 and 3.5, Tables 3.1 and 3.2); by rising number of robots.
    pub(crate) growth: Vec<CurveRow>,
    /// Some robots are capable (3.6.4, Fig. 3.8); by rising number of robots, within these by
    /// rising number of capable ones.
    pub(crate) benchmark: Vec<BenchmarkRow>,
    /// Path of the page; none unless asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) report: Option<String>,
}

/// Work and messages of a team.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CurveRow {
    pub(crate) robots: u64,
    /// Without the empty one.
    pub(crate) coalitions: u64,
    /// The auctioneer looks at all coalitions (`MuRoCo`).
    pub(crate) central_steps: u64,
    /// Coalitions are shared out (`MuRoCo`-D, Algorithm A.1): steps of the busiest robot.
    pub(crate) distributed_steps: u64,
    /// Orderings of robots that an exhaustive search takes; none for more than nine robots.
    pub(crate) orderings: Option<u64>,
    /// Steps of one assignment a plan, as this program takes them: k²n for k roles and n robots.
    pub(crate) assignment_steps: u64,
    pub(crate) bounds: BoundsRow,
    pub(crate) messages: MessagesRow,
    /// Steps that a message may take before `MuRoCo` is quicker than `MuRoCo`-D, rounded down; none
    /// where it sends no more.
    pub(crate) steps_a_message: Option<u64>,
}

/// Bounds of the thesis (Table 3.2) for n robots and one plan of each size.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BoundsRow {
    /// 2ⁿn³.
    pub(crate) central_steps: u64,
    /// 2ⁿn².
    pub(crate) distributed_steps: u64,
    /// n!.
    pub(crate) orderings: u64,
    /// Share of the robots, in thousandths, from which on a search with such a limit of the size
    /// of coalitions is as slow as `MuRoCo` (Fig. 3.5a); above 1,000 it never is.
    pub(crate) size_limit_permille: u64,
    /// As counted, but by the bounds (Fig. 3.5b): 2ⁿ⁻¹(n-1).
    pub(crate) steps_a_message: u64,
}

/// Messages of a round, counted in a simulated run (Table 3.1).
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MessagesRow {
    /// As many tasks of one robot as robots.
    pub(crate) singles: u64,
    /// One task of all robots, by `MuRoCo`.
    pub(crate) central: u64,
    /// The same by `MuRoCo`-D.
    pub(crate) distributed: u64,
}

/// Work of a team of which some robots are capable.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct BenchmarkRow {
    pub(crate) robots: u64,
    /// Robots that can fill a role; the others have one of the two capabilities that all roles
    /// need, in turns.
    pub(crate) capable: u64,
    pub(crate) coalitions: u64,
    /// Steps to assign the roles of all coalitions.
    pub(crate) steps: u64,
    /// Steps for coalitions that are capable alone.
    pub(crate) capable_steps: u64,
    /// The same for the busiest robot, where coalitions are shared out.
    pub(crate) busiest_steps: u64,
    pub(crate) conditions: Vec<CapableRow>,
}

/// A condition that a coalition must meet to be capable (3.5.2.3).
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CapableRow {
    /// `cap1`: all robots together could fill each role; `cap2`: each role has a robot that can;
    /// `cap3`: each has a robot of its own.
    pub(crate) name: &'static str,
    /// Coalitions that meet it.
    pub(crate) passed: u64,
    /// Their share, in thousandths, rounded down.
    pub(crate) passed_permille: u64,
    /// The condition should pay up to this share, by the rule of the thesis (3.17).
    pub(crate) rule_permille: u64,
    /// Steps with the condition first (3.16): 2z, z² and z³ for it, and z³ for each coalition that
    /// meets it.
    pub(crate) steps: u64,
    /// Says whether these are fewer than without a condition.
    pub(crate) pays: bool,
}
