//! The notes of a campaign beside the faults of a failure, so that it can be run again and
//! compared.

use super::Faults;
use crate::missions::terms::PlannedFor;

/// A `panorama-faults/1` file with all that it says.
///
/// ```
/// use cotama_models::missions::{Mission, embedded, faults::FaultsFile};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let text = "format = 'panorama-faults/1'
/// [planner]
/// objective = 'quality'
/// allocator = 'exact'
/// steps = 1000
/// policy = 'rigid'
/// [expected]
/// requirement = 'completed'
/// outcome = 'failed'
/// time_ms = 600_001
/// energy_mj = 5
/// x_mm = 187_000";
/// let file = FaultsFile::parse("001.toml", text, &mission).unwrap();
/// assert_eq!(file.expected.unwrap().end.time_ms, 600_001);
/// assert_eq!(file.planner.unwrap().steps, Some(1_000));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaultsFile {
    /// The faults.
    pub faults: Faults,
    /// The planner, if the file names one.
    pub planner: Option<PlannedBy>,
    /// The failure that it is of, if it is of one.
    pub expected: Option<Expected>,
}

/// The planner of the recorded run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlannedBy {
    /// The criterion by which plans are chosen.
    pub objective: PlannedFor,
    /// Whether by a complete search (`exact`), else by the rule of PANORAMA (`panorama`).
    pub exact: bool,
    /// The most steps of a search; the usual if none.
    pub steps: Option<u64>,
    /// How plans are adapted.
    pub policy: Adapts,
    /// Fidelity of the robot's model, as a position in [`FIDELITIES`].
    pub fidelity: usize,
}

/// Names of how closely a robot is modelled: on a line, in the plane, in the plane by its signals
/// alone.
pub const FIDELITIES: [&str; 3] = ["line", "plane", "signal"];

/// How plans are adapted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Adapts {
    /// When a margin is below zero, or what a plan needs is lost.
    #[default]
    Usual,
    /// To better plans too, when margins have grown.
    Upward,
    /// Never.
    Rigid,
}

impl Adapts {
    /// All, with their names in files.
    pub const NAMES: [(&'static str, Self); 3] =
        [("usual", Self::Usual), ("upward", Self::Upward), ("rigid", Self::Rigid)];
}

/// A failure: what broke, and how the run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// The mission: the name of an embedded one, or the path of a file.
    pub mission: Option<String>,
    /// The robot under whose supervisors a mission is that names none: its name, or the path of its
    /// file.
    pub robot: Option<String>,
    /// The seed of the run.
    pub seed: u64,
    /// The requirement that broke.
    pub requirement: String,
    /// How the run ended.
    pub end: Ending,
}

/// How a run ended, in the terms of every run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ending {
    /// `completed`, `safe` or `failed`.
    pub outcome: &'static str,
    /// The time used, in ms.
    pub time_ms: u64,
    /// The energy used, in mJ.
    pub energy_mj: u64,
    /// How far the robot came, in mm.
    pub x_mm: u64,
    /// How often plans were made again; not compared if none.
    pub replans: Option<u64>,
    /// How often the operator was asked; not compared if none.
    pub requests: Option<u64>,
    /// The longest time that the robot moved without a module that it required, in ms; not compared
    /// if none.
    pub exposed_ms: Option<u64>,
    /// When the requirement was broken, in ms, if that ended the run.
    pub broken_ms: Option<u64>,
}

/// How a run can end.
pub const OUTCOMES: [&str; 3] = ["completed", "safe", "failed"];
