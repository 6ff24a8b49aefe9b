//! The answers in JSON: types that are written, and from which `schemas/cotama.json` is made.

pub(crate) mod assign;
pub(crate) mod axes;
pub(crate) mod axes_run;
pub(crate) mod campaign;
pub(crate) mod check;
pub(crate) mod conform;
pub(crate) mod curves;
pub(crate) mod error;
pub(crate) mod estimate;
pub(crate) mod explain;
pub(crate) mod floor;
pub(crate) mod fmeca;
pub(crate) mod model;
pub(crate) mod new;
pub(crate) mod risk;
pub(crate) mod supervised;
pub(crate) mod team;
pub(crate) mod ways;

use axes_run::FurtherMargin;
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama list`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ListAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/list/1")))]
    pub(crate) schema: &'static str,
    /// Missions, for `plan`, `run` and `table`.
    pub(crate) missions: Vec<Listed>,
    /// Models.
    pub(crate) models: Vec<Listed>,
    /// Robots, for `check`, `show` and what takes a model.
    pub(crate) robots: Vec<Listed>,
    /// Scenarios.
    pub(crate) scenarios: Vec<Listed>,
    /// Maps.
    pub(crate) maps: Vec<Listed>,
}

/// Something that comes with the program.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Listed {
    /// Name; of a family of nets with `:N` in place of the number.
    pub(crate) name: String,
    /// Description in one line.
    pub(crate) description: String,
}

/// The knowledge of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum Status {
    /// There is a plan, and it is proven that none is better.
    Optimal,
    /// There is a plan; a better one may exist.
    Feasible,
    /// No plan exists, which is proven.
    Infeasible,
    /// No plan was found, but one may exist.
    Unknown,
}

/// The answer of `cotama plan`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PlanAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/plan/1")))]
    pub(crate) schema: &'static str,
    /// The name of the mission.
    pub(crate) mission: String,
    /// The activities, in sequence.
    pub(crate) activities: Vec<ActivityRow>,
    /// How fast the robot can be.
    pub(crate) speed_robot_mm_s: u64,
    /// How fast it may be so that an impact hurts nobody: what follows from its mass and from the
    /// mission's `impact_energy_max_mj`.
    pub(crate) speed_harmless_mm_s: u64,
    /// How many plans there are, within the limits or not, in decimal; `more than 2^128` beyond.
    pub(crate) combinations: String,
    /// Objective of the plan: `paper`, `quality`, `min-energy` or `front`.
    pub(crate) objective: &'static str,
    /// Allocator that found the plan: `panorama` or `exact`.
    pub(crate) allocator: Option<&'static str>,
    pub(crate) status: Status,
    /// One row an activity; empty without a plan.
    pub(crate) plan: Vec<PlanRow>,
    pub(crate) duration_ms: Option<u64>,
    pub(crate) energy_mj: Option<u64>,
    pub(crate) quality: Option<u64>,
    pub(crate) duration_limit_ms: u64,
    pub(crate) energy_limit_mj: u64,
    /// Limit less plan.
    pub(crate) duration_margin_ms: Option<i64>,
    /// Limit less plan.
    pub(crate) energy_margin_mj: Option<i64>,
    /// No plan within the limits has more of the objective (less, for `min-energy`); none if
    /// nothing is proven.
    pub(crate) bound: Option<u64>,
    /// The work done, in steps of the allocator; not counted for a front.
    pub(crate) steps: u64,
    /// For the objective `front`: all plans of which none is better in duration, energy and
    /// quality, by duration.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) front: Option<Vec<FrontRow>>,
    /// Why there is no plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) reason: Option<Reason>,
}

/// An activity.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ActivityRow {
    pub(crate) id: String,
    pub(crate) objective: String,
    pub(crate) x_start_mm: u64,
    pub(crate) x_end_mm: u64,
    /// The candidates that constraints and hardware leave.
    pub(crate) candidates: u64,
    /// The candidates before constraints.
    pub(crate) candidates_before: u64,
    /// Zero when it does not travel.
    pub(crate) speed_max_mm_s: u64,
}

/// An activity in a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PlanRow {
    pub(crate) activity: String,
    /// The options taken together, as `M5 L2`.
    pub(crate) choice: String,
    /// Zero when it does not travel.
    pub(crate) speed_mm_s: u64,
    pub(crate) duration_ms: u64,
    pub(crate) energy_mj: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) quality: Option<u64>,
}

/// A plan of the front.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct FrontRow {
    pub(crate) duration_ms: u64,
    pub(crate) energy_mj: u64,
    pub(crate) quality: u64,
    /// For each activity the options taken together, as `M5 L2`.
    pub(crate) choice: Vec<String>,
}

/// Why there is no plan.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Reason {
    /// The same in words.
    pub(crate) text: String,
    /// The axis whose limit cannot be met: `duration` or `energy`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) axis: Option<String>,
    /// The activity that is left without candidates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) activity: Option<String>,
    /// The limit, in ms or mJ.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) limit: Option<u64>,
    /// The least total on this axis, within the limits that are treated before it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) least: Option<u64>,
    /// Least less limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) gap: Option<u64>,
    /// The activities that need the most, the heaviest first.
    pub(crate) heaviest: Vec<Heavy>,
    /// Changes that would make a plan possible, the smallest one first.
    pub(crate) relaxations: Vec<Relaxation>,
}

/// An activity that needs much.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Heavy {
    pub(crate) activity: String,
    /// Cost on the axis of the reason, in ms or mJ, in the plan that needs least there.
    pub(crate) cost: u64,
    /// Share of the total, in thousandths.
    pub(crate) permille: u16,
    /// The same in words.
    pub(crate) text: String,
}

/// A change after which there is a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Relaxation {
    #[serde(flatten)]
    pub(crate) change: Change,
    /// The same in words.
    pub(crate) text: String,
}

/// The change.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum Change {
    /// Raise one limit, or both.
    RaiseLimit {
        /// The least duration limit that suffices, if it is to be raised.
        duration_limit_ms: Option<u64>,
        /// The least energy limit that suffices, if it is to be raised.
        energy_limit_mj: Option<u64>,
    },
    /// Lift constraints of zones, all of these.
    LiftConstraint { constraints: Vec<ZoneConstraint> },
    /// Keep, or repair, hardware, all of this.
    KeepHardware { hardware: Vec<Kept> },
    /// Drop an objective; one that travels takes all that follow with it.
    DropObjective { objective: String },
}

/// A constraint of a zone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ZoneConstraint {
    pub(crate) zone: String,
    /// `hardware` or `option`: what the zone requires.
    pub(crate) constraint: &'static str,
}

/// Hardware that must work.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Kept {
    pub(crate) hardware: String,
    /// So many units must work.
    pub(crate) units: u8,
}

/// The answer of `cotama allocate`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct AllocateAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/allocate/1")))]
    pub(crate) schema: &'static str,
    pub(crate) status: Status,
    pub(crate) quality: Option<u64>,
    pub(crate) duration_ms: Option<u64>,
    pub(crate) energy_mj: Option<u64>,
    /// For each activity the index of its candidate, from 0; empty without a plan.
    pub(crate) choice: Vec<u16>,
    /// No plan within the limits has more quality (less energy, for `min-energy`); none if nothing
    /// is proven.
    pub(crate) bound: Option<u64>,
    /// The work done, in steps of the allocator.
    pub(crate) steps: u64,
    /// Why there is no plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) reason: Option<Reason>,
}

/// How a mission ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum Outcome {
    /// All activities are done, within the limits.
    Completed,
    /// The robot stopped safely, or never left.
    Safe,
    /// All activities are done beyond a limit; or a supervised mission was not done in an hour.
    Failed,
}

/// The answer of `cotama run`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RunAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/run/1")))]
    pub(crate) schema: &'static str,
    #[serde(flatten)]
    pub(crate) run: RunBody,
}

/// The answer of `cotama replay`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ReplayAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/replay/1")))]
    pub(crate) schema: &'static str,
    /// Whether the run was the same again: in every record of a trace, or in all that a failure
    /// records of its end; none where nothing is recorded.
    pub(crate) identical: Option<bool>,
    /// Whether the failure that a file of faults records comes back: its requirement is broken
    /// again, in the same run; none for what records no failure.
    pub(crate) returns: Option<bool>,
    /// Planner, in words.
    pub(crate) planner: String,
    /// The first record of a trace that differs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) difference: Option<RecordDifference>,
    /// The failure that a file of faults records, and what became of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) failure: Option<RecordedFailure>,
    #[serde(flatten)]
    pub(crate) run: RunBody,
}

/// A record of a trace that is not the one of now.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RecordDifference {
    /// Line of the record, from 1.
    pub(crate) line: u64,
    /// Kind of the record, as `sample`; `header` for the first line.
    pub(crate) record: String,
    /// The field; none where there is no such record on one side.
    pub(crate) field: Option<String>,
    /// Stored value, as JSON.
    pub(crate) stored: Option<String>,
    /// Present value, as JSON.
    pub(crate) now: Option<String>,
}

/// A failure that was run again.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RecordedFailure {
    /// The requirement that was broken.
    pub(crate) requirement: String,
    /// Whether it is broken again.
    pub(crate) broken: bool,
    /// How the run ended, in words.
    pub(crate) expected: String,
    /// How it ends now.
    pub(crate) found: String,
    /// In what the ends differ.
    pub(crate) differences: Vec<EndDifference>,
}

/// Something that was recorded of an end, and is not so now.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct EndDifference {
    /// Key in the file.
    pub(crate) key: String,
    pub(crate) expected: String,
    pub(crate) found: String,
}

/// The result of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RunBody {
    /// The name of the mission.
    pub(crate) mission: String,
    pub(crate) seed: u64,
    pub(crate) outcome: Outcome,
    /// Why it is not completed.
    pub(crate) reason: Option<String>,
    /// Why there is no plan at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) infeasible: Option<Reason>,
    /// The plans that came into force, the first one that of the start.
    pub(crate) plans: Vec<PlanMade>,
    /// How many plans there were after the first.
    pub(crate) replans: u64,
    pub(crate) operator_requests: u64,
    /// Limit less used, at the end; none if the robot never left.
    pub(crate) duration_margin_ms: Option<i64>,
    /// Limit less used, at the end; none if the robot never left.
    pub(crate) energy_margin_mj: Option<i64>,
    pub(crate) duration_ms: u64,
    pub(crate) energy_mj: u64,
    /// How far the robot came.
    pub(crate) x_mm: u64,
    /// Events of the robot.
    pub(crate) events: Vec<EventRow>,
    /// Actions of the supervisors; of a supervised mission alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) supervised: Option<supervised::Supervised>,
    /// Margins that were held back, and whether the run kept within them; with margins alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) held: Option<risk::HeldAnswer>,
    /// The path of the report.
    pub(crate) report: Option<String>,
    /// The path of the trace.
    pub(crate) trace: Option<String>,
    /// Paths of the files for other tools.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) recordings: Vec<String>,
}

/// A plan that came into force.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PlanMade {
    /// `start`, `energy margin below zero`, `one laser lost` and the like.
    pub(crate) cause: String,
    pub(crate) time_ms: u64,
    pub(crate) x_mm: u64,
    /// The id of the first activity that it is about.
    pub(crate) first_activity: String,
    pub(crate) plan: Vec<PlanRow>,
    /// The margin that the plan before would have had; none at the start.
    pub(crate) duration_margin_before_ms: Option<i64>,
    /// The margin that the plan before would have had; none at the start.
    pub(crate) energy_margin_before_mj: Option<i64>,
    pub(crate) duration_margin_after_ms: i64,
    pub(crate) energy_margin_after_mj: i64,
    pub(crate) steps: u64,
    /// `panorama`, `exact` or, within further limits of axes, `axes`.
    pub(crate) allocator: String,
    /// The margins of further sums that axes limit.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) further: Vec<FurtherMargin>,
}

/// Something that happened to the robot.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct EventRow {
    pub(crate) time_ms: u64,
    pub(crate) x_mm: u64,
    /// `obstacle`, `odometry`, `fault` or `repair`.
    pub(crate) kind: &'static str,
    /// In words.
    pub(crate) text: String,
    /// The time that it took.
    pub(crate) lost_ms: u64,
    /// The hardware of a fault or a repair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hardware: Option<String>,
    /// The units lost by a fault, or back by a repair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) units: Option<u8>,
    /// The units that work after a fault or a repair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) units_left: Option<u8>,
    /// The additional path of wrong odometry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) extra_mm: Option<u64>,
}
