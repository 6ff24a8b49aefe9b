//! The answer of `cotama run` for teams.

use super::{RecordDifference, RecordedFailure};
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// The answer of `cotama run` and `cotama replay` for teams.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TeamAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/run-team/1")))]
    pub(crate) schema: &'static str,
    /// The name of the team: `fleet`, `service`, or that of a file.
    pub(crate) scenario: String,
    /// `completed` if all tasks are done, else `reported`; `failed` if something did not hold that
    /// must hold of every run.
    pub(crate) outcome: &'static str,
    pub(crate) seed: u64,
    pub(crate) robots: u64,
    pub(crate) tasks: u64,
    pub(crate) loss_permille: u16,
    /// One run; none where many seeds are compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) run: Option<TeamRun>,
    /// Many runs, a row for each allocation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) compared: Option<Compared>,
    /// Whether a run made again from its trace was the same in every record; none where no trace
    /// was replayed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) identical: Option<bool>,
    /// Whether the failure that a file of faults records comes back; none for what records none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) returns: Option<bool>,
    /// The failure that a file of faults records, and what became of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) failure: Option<RecordedFailure>,
    /// The first record of the trace that differs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) difference: Option<RecordDifference>,
}

/// One run.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TeamRun {
    /// `optimal`, `rounds` or `one-by-one`.
    pub(crate) allocation: String,
    pub(crate) done: u64,
    pub(crate) reported: u64,
    /// When the last task ended.
    pub(crate) duration_ms: u64,
    /// For how long robots worked, all together.
    pub(crate) robot_time_ms: u64,
    /// Energy that robots drew until the end, all together.
    pub(crate) energy_mj: u64,
    /// The robot time, with the utility of tasks that are not done.
    pub(crate) cost_ms: u64,
    /// From when a task became known until it was done, on average.
    pub(crate) mean_time_ms: u64,
    pub(crate) auctions: u64,
    /// How often a task was put up again.
    pub(crate) reopened: u64,
    /// Robots that cannot work any more.
    pub(crate) robots_out: u64,
    /// How often a robot took over from an auctioneer that was silent.
    pub(crate) takeovers: u64,
    /// Messages sent, by their kind.
    pub(crate) messages: BTreeMap<&'static str, u64>,
    pub(crate) messages_lost: u64,
    /// The performance of the team (2.7): of the utility of all tasks what is left when the time of
    /// robots, and the utility of tasks that are not done, are taken away, in thousandths; none
    /// where all utilities are 0.
    pub(crate) performance_permille: Option<i64>,
    /// Uses of skills that failed: an action was repeated, or its task given back.
    pub(crate) failed_uses: u64,
    /// Number of times that a robot was charged.
    pub(crate) charges: u32,
    /// Skills that may fail or are counted, with their uses in the run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) skills: Vec<SkillRow>,
    /// Awards of tasks to robots.
    pub(crate) awards: Vec<AwardRow>,
    /// Errors of robots in their tasks, by class.
    pub(crate) errors: Vec<TeamErrorRow>,
    /// Path of the report.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) report: Option<String>,
    /// Path of the trace.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) trace: Option<String>,
}

/// The uses of a skill.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct SkillRow {
    pub(crate) robot: String,
    pub(crate) skill: String,
    /// Uses that the skill decided.
    pub(crate) uses: u32,
    pub(crate) failed: u32,
    /// What the robot takes its reliability to be at the end, in parts per 10⁹.
    pub(crate) reliability: u32,
}

/// An award.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AwardRow {
    pub(crate) t_ms: u64,
    pub(crate) round: u32,
    pub(crate) task: String,
    pub(crate) plan: String,
    /// The robot of each role.
    pub(crate) robots: Vec<String>,
    /// Planned cost of each role, in ms.
    pub(crate) costs_ms: Vec<u32>,
    /// Probability that no action of each role fails, as its robot takes it to be, in parts per
    /// 10⁹; none where all are certain.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) success: Vec<u32>,
}

/// An error.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TeamErrorRow {
    pub(crate) t_ms: u64,
    pub(crate) robot: String,
    pub(crate) task: String,
    /// `recoverable`, `semi-recoverable` or `non-recoverable`.
    pub(crate) class: String,
    pub(crate) why: String,
}

/// Many runs.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Compared {
    /// How many seeds were run with each allocation, from `seed` on.
    pub(crate) seeds: u64,
    /// The level of the intervals.
    pub(crate) confidence_permille: u16,
    /// A row for each allocation, where these are compared.
    pub(crate) allocations: Vec<ComparedRow>,
    /// A row for what bids take the reliability of skills to be, where that is compared.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) trusts: Vec<TrustRow>,
}

/// All runs in which bids take the reliability of skills to be the same.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TrustRow {
    /// `certain`, `stated`, `learned` or `known`.
    pub(crate) trust: &'static str,
    /// Time of robots, with the utility of what is not done, a run.
    pub(crate) cost_ms: Interval,
    /// Cost beyond that of the first row, seed by seed.
    pub(crate) more_ms: Interval,
    pub(crate) more_permille: Interval,
    /// From when a task became known until it was done.
    pub(crate) mean_time_ms: Interval,
    /// The same beyond that of the first row, seed by seed.
    pub(crate) more_time_ms: Interval,
    /// Uses of skills that may fail, in thousandths a run.
    pub(crate) uses_milli: Interval,
    /// Uses that failed, in thousandths a run: an action was repeated, or its task given back.
    pub(crate) failed_milli: Interval,
    /// The same beyond that of the first row, seed by seed.
    pub(crate) more_failed_milli: Interval,
    /// Awards to robots with such skills that would have gone to others had all known how often
    /// they fail, in thousandths a run.
    pub(crate) undue_milli: Interval,
    /// The number of these over all runs, by how often the robot had used such skills before: below
    /// 10 times, 10 to 19, and so on; the last ones are more.
    pub(crate) undue_by_uses: Vec<u64>,
    pub(crate) done: u64,
    pub(crate) reported: u64,
    pub(crate) reopened: u64,
    pub(crate) unsound: u64,
}

/// All runs with an allocation.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ComparedRow {
    pub(crate) allocation: &'static str,
    /// Time of robots, with the utility of what is not done, a run.
    pub(crate) cost_ms: Interval,
    /// From when a task became known until it was done.
    pub(crate) mean_time_ms: Interval,
    /// Cost beyond that of the first allocation, seed by seed.
    pub(crate) more_ms: Interval,
    pub(crate) more_permille: Interval,
    pub(crate) done: u64,
    pub(crate) reported: u64,
    pub(crate) reopened: u64,
    /// Runs of which something did not hold that must hold of every run.
    pub(crate) unsound: u64,
}

/// A mean, and its interval.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Interval {
    pub(crate) mean: i64,
    pub(crate) low: i64,
    pub(crate) high: i64,
}
