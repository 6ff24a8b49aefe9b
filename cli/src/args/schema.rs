//! The command line of `cotama schema`.

use clap::{Args, ValueEnum};

#[derive(Args, Debug)]
pub(crate) struct SchemaArgs {
    /// The command, or the kind of file
    #[arg(value_enum, value_name = "WHAT")]
    pub(crate) of: SchemaName,
}

/// Commands that answer in JSON, and files that users write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaName {
    List,
    Plan,
    /// The answer of `plan` for a mission with axes
    PlanAxes,
    Explain,
    /// The answer of `explain` for a team
    ExplainTeam,
    Run,
    /// The answer of `run` for a mission with axes
    RunAxes,
    /// The answer of `run` for a team
    RunTeam,
    /// The answer of `run two-ways`
    RunTwoWays,
    Allocate,
    Assign,
    /// The answer of `assign --curves`
    AssignCurves,
    Replay,
    Models,
    Simulate,
    Play,
    /// The answer of `simulate` for a behaviour tree
    SimulateTree,
    Check,
    /// The answer of `check` for a behaviour tree
    CheckTree,
    Statespace,
    /// The answer of `statespace` for a behaviour tree
    StatespaceTree,
    Estimate,
    Verify,
    Conform,
    /// The answer of `conform` for a behaviour tree
    ConformTree,
    Floor,
    Fmeca,
    Measure,
    Campaign,
    RiskLearn,
    RiskInfer,
    RiskCoherence,
    RiskDiscretise,
    RiskSeparated,
    RiskChoose,
    RiskCalibrate,
    New,
    /// A line of a recorded run
    Recording,
    /// Answer in place of another one when there is none
    Error,
    /// A mission file, in TOML
    Mission,
    /// A robot's file, in TOML
    Robot,
    /// A file of faults, in TOML
    Faults,
}
