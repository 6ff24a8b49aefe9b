//! The trace of a run: JSON lines, `cotama-trace/1`, enough to draw it and to run it again.
//!
//! The first line is the [`Header`], every other line one [`Record`], the last one its [`End`].
//! Every record says when (`t_us`, µs since the start) and where (`x_mm`, whole mm of path that are
//! behind the robot). Numbers are integers; durations are ms, energies mJ, powers mW, speeds mm/s.

use crate::run::Outcome;
use serde::{Deserialize, Serialize};

mod compare;
mod event;
mod floor;
mod pose;
mod read;
mod replay;
mod robot;
mod run_options;
pub mod supervised;

pub use compare::Difference;
pub use event::{Event, Occurrence};
pub use floor::{FloorText, LegText};
pub use pose::Pose;
pub use read::{Head, Limits, Line, TraceError, TraceOf};
pub use replay::{RecordError, Replayed, replay};
pub use robot::RobotText;
pub use run_options::{RunFaults, RunOptions, RunUpward};

/// The schema that a trace names in its header.
pub const SCHEMA: &str = "cotama-trace/1";

/// The trace of a mission.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::Options;
/// use cotama_sim::trace::{Record, Trace};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let (trace, _) = Trace::record(&mission, &Options::default()).unwrap();
/// assert_eq!((trace.header.schema.as_str(), &trace.foreign), ("cotama-trace/1", &None));
/// let plans = trace.records.iter().filter(|it| matches!(it, Record::Plan(_))).count();
/// assert_eq!(plans, 4);
/// assert!(matches!(trace.records.last(), Some(Record::End(_))));
/// ```
pub type Trace = TraceOf<Header, Record>;

impl Head for Header {
    const SCHEMA: &'static str = SCHEMA;

    fn schema(&self) -> &str {
        &self.schema
    }

    fn by_version_of(self, other: &Self) -> Self {
        Self { version: other.version.clone(), ..self }
    }
}

impl Line for Record {
    fn time(&self) -> u64 {
        self.t_us()
    }

    fn is_end(&self) -> bool {
        matches!(self, Self::End(_))
    }
}

/// The settings of a run: enough to run it again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// [`SCHEMA`].
    pub schema: String,
    /// The version of the package that wrote the trace.
    pub version: String,
    /// The name of the mission's source: that of an embedded mission, or of a file.
    pub mission_source: String,
    /// The whole text of the mission file.
    pub mission: String,
    /// The file of the robot whose supervisors decided; none where none did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<RobotText>,
    /// The floor that the mission goes over; none where it names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<FloorText>,
    /// How it was run.
    pub options: RunOptions,
    /// The limits on duration and energy.
    pub limits: Used,
    /// The length of the path, in mm.
    pub path_length_mm: u64,
}

/// An amount on both axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Used {
    /// In ms.
    pub duration_ms: u64,
    /// In mJ.
    pub energy_mj: u64,
}

/// A margin on both axes: limit less used less planned rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Margins {
    /// In ms.
    pub duration_ms: i64,
    /// In mJ.
    pub energy_mj: i64,
}

impl From<[u64; 2]> for Used {
    fn from([duration_ms, energy_mj]: [u64; 2]) -> Self {
        Self { duration_ms, energy_mj }
    }
}

impl From<Used> for [u64; 2] {
    fn from(used: Used) -> Self {
        [used.duration_ms, used.energy_mj]
    }
}

impl From<[i64; 2]> for Margins {
    fn from([duration_ms, energy_mj]: [i64; 2]) -> Self {
        Self { duration_ms, energy_mj }
    }
}

/// One line of a trace after the header.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "record", rename_all = "snake_case")]
pub enum Record {
    /// A new plan is in force.
    Plan(Box<Plan>),
    /// An activity starts.
    Activity(Activity),
    /// The margins were checked.
    Sample(Sample),
    /// Pose of the robot in the plane; after every sample.
    Pose(Pose),
    /// Something happened to the robot; written when it is over.
    Event(Event),
    /// The operator is asked.
    Request(Request),
    /// No plan is left: the mission is aborted.
    Abort(Abort),
    /// A transition of a supervisor fired.
    Fired(supervised::Fired),
    /// The supervisors were told something.
    Told(supervised::Told),
    /// Something failed that supervisors deal with.
    Failure(supervised::Failure),
    /// A failure was noticed and diagnosed.
    Diagnosis(supervised::Diagnosis),
    /// The contextual supervisor decided on it.
    Decision(supervised::Decision),
    /// The robot has moved without a module that it required.
    Exposure(supervised::Exposure),
    /// Other modules run.
    Configuration(supervised::Configured),
    /// Something else is known to be lost, or works again.
    Status(supervised::Status),
    /// The mission is over.
    End(End),
}

impl Record {
    /// When it was written, in µs since the start.
    pub fn t_us(&self) -> u64 {
        match self {
            Self::Plan(it) => it.t_us,
            Self::Activity(it) => it.t_us,
            Self::Sample(it) => it.t_us,
            Self::Pose(it) => it.t_us,
            Self::Event(it) => it.t_us,
            Self::Request(it) => it.t_us,
            Self::Abort(it) => it.t_us,
            Self::Fired(it) => it.t_us,
            Self::Told(it) => it.t_us,
            Self::Failure(it) => it.t_us,
            Self::Diagnosis(it) => it.t_us,
            Self::Decision(it) => it.t_us,
            Self::Exposure(it) => it.t_us,
            Self::Configuration(it) => it.t_us,
            Self::Status(it) => it.t_us,
            Self::End(it) => it.t_us,
        }
    }

    /// Returns the position at the time of writing, in whole mm of path.
    pub fn x_mm(&self) -> u64 {
        match self {
            Self::Plan(it) => it.x_mm,
            Self::Activity(it) => it.x_mm,
            Self::Sample(it) => it.x_mm,
            Self::Pose(it) => it.x_mm,
            Self::Event(it) => it.x_mm,
            Self::Request(it) => it.x_mm,
            Self::Abort(it) => it.x_mm,
            Self::Fired(it) => it.x_mm,
            Self::Told(it) => it.x_mm,
            Self::Failure(it) => it.x_mm,
            Self::Diagnosis(it) => it.x_mm,
            Self::Decision(it) => it.x_mm,
            Self::Exposure(it) => it.x_mm,
            Self::Configuration(it) => it.x_mm,
            Self::Status(it) => it.x_mm,
            Self::End(it) => it.x_mm,
        }
    }
}

/// A new plan: the resource allocation solution of what is left of the mission.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plan {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// Why: `start`, `energy margin below zero`, `duration margin below zero`, `one laser lost` and
    /// the like, `room for a better plan`.
    pub cause: String,
    /// The id of the first activity of the plan: the current one, or the next if it is just done.
    pub first_activity: String,
    /// The margins that the plan before would have had; none at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<Margins>,
    /// The margins of this plan: limits less used less the sum of its rows.
    pub after: Margins,
    /// Amounts used so far.
    pub used: Used,
    /// One row an activity, from the first on.
    pub plan: Vec<PlanRow>,
    /// The work that planning took, in steps of the allocator.
    pub steps: u64,
    /// The allocator that found the plan: `panorama` or `exact`.
    pub allocator: String,
    /// Amounts that would be left at each safe end if the robot went there the most expensive way.
    pub return_margin: ReturnMargin,
    /// Margins of further sums, in a mission with axes that limits some.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<FurtherMargin>,
}

/// The margin of a sum beyond duration and energy.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FurtherMargin {
    /// The end constraint that limits it.
    pub constraint: String,
    /// The margin, in the unit of the indicator; of an `at least` what is there beyond it.
    pub margin: i64,
}

/// One activity of a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlanRow {
    /// The id of the activity.
    pub activity: String,
    /// The implementation alternative, as `M5 L2`.
    pub choice: String,
    /// The speed; zero when the activity does not travel.
    pub speed_mm_s: u64,
    /// The planned duration of what is left of the activity.
    pub duration_ms: u64,
    /// The planned energy of what is left of the activity.
    pub energy_mj: u64,
}

/// The margins left at the safe ends of the mission, by the most expensive available way; below
/// zero, reaching that end is not guaranteed. None if the available hardware offers no way, and in
/// a supervised run, which does not look for one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReturnMargin {
    /// Going on to the end of the mission, activities included.
    pub end: Option<Margins>,
    /// Travelling back to the start.
    pub start: Option<Margins>,
}

/// An activity starts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Activity {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// Id of the activity.
    pub activity: String,
    /// The implementation alternative, as `M5 L2`.
    pub choice: String,
    /// The speed; zero when it does not travel.
    pub speed_mm_s: u64,
}

/// The margins were checked: every period, after every event, at every new activity. Another sample
/// follows every plan, with the margins and the power under it. Supervisors check the margins every
/// second; there a sample is taken every period, and speed and power are those of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sample {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// Amounts used so far, rounded half up.
    pub used: Used,
    /// The margins under the plan in force.
    pub margins: Margins,
    /// The planned power, in mW.
    pub planned_power_mw: u64,
    /// The real power, rounded half up, in mW.
    pub real_power_mw: u64,
    /// The speed, in mm/s; zero when the robot stands or waits.
    pub speed_mm_s: u64,
}

/// The supervisors ask the operator.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Request {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// Diagnosis of the failure.
    pub cause: String,
    /// Why he is asked.
    pub reason: String,
}

/// A plan was needed, and there is none: the robot stops, and the mission is aborted (Lambert et
/// al., J. Intell. Robot. Syst. 110, 2024, Section 7.3.2). Nobody is asked where no supervisors
/// are.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Abort {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// Why a plan was needed, worded as in [`Plan::cause`].
    pub cause: String,
    /// Why there is none.
    pub reason: String,
}

/// The mission is over.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct End {
    /// When, in µs.
    pub t_us: u64,
    /// Position, in mm.
    pub x_mm: u64,
    /// The outcome.
    pub outcome: Outcome,
    /// Why it is not completed; none if it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Limits less used: nothing is planned any more.
    pub margins: Margins,
    /// Amounts used.
    pub used: Used,
    /// How many plans there were after the first.
    pub replans: u64,
    /// How often the operator was asked.
    pub operator_requests: u64,
}
