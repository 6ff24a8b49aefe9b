//! The command line of the commands about missions and plans.

use super::number::{duration, energy, whole};
use super::{Json, MissionArg, RecordingArgs, TeamArgs, WaysArgs};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

pub(crate) use cotama_sim::options::STEPS;

/// The planner and its options.
#[derive(Args, Clone, Debug)]
pub(crate) struct Planning {
    /// Planner: the rule of PANORAMA, or a complete search
    /// [default: panorama for the objective paper, else exact]
    #[arg(long, value_enum, value_name = "WHO", hide_possible_values = false)]
    pub(crate) allocator: Option<AllocatorName>,
    /// The most steps of a complete search
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    #[arg(value_parser = whole(1, u64::MAX))]
    pub(crate) steps: u64,
    /// Hardware lost from the start, as `laser:1`; all units of the kind when no number is given
    #[arg(long, value_name = "KIND[:UNITS]", value_parser = lost)]
    pub(crate) lost: Vec<Lost>,
    /// A duration limit in place of the mission's own, in ms
    #[arg(long, value_name = "ms", value_parser = duration)]
    pub(crate) duration_limit: Option<u64>,
    /// An energy limit in place of the mission's own, in mJ
    #[arg(long, value_name = "mJ", value_parser = energy)]
    pub(crate) energy_limit: Option<u64>,
    /// A plain mission under the supervisors of a robot: its name, or its file [`patrol` has one]
    #[arg(long, value_name = "ROBOT", num_args = 0..=1, default_missing_value = "")]
    pub(crate) supervised: Option<String>,
}

impl Planning {
    /// The first of these options that was given, the number of steps aside.
    pub(crate) fn first(&self) -> Option<&'static str> {
        let given = [
            ("--allocator", self.allocator.is_some()),
            ("--lost", !self.lost.is_empty()),
            ("--duration-limit", self.duration_limit.is_some()),
            ("--energy-limit", self.energy_limit.is_some()),
            ("--supervised", self.supervised.is_some()),
        ];
        given.into_iter().find(|it| it.1).map(|it| it.0)
    }
}

#[derive(Args, Debug)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    pub(crate) mission: MissionArg,
    /// Objective of the plan: the paper's rule, the most quality, the least energy, or all plans of
    /// which none is better in duration, energy and quality
    /// [default: that of the mission file, else quality]
    #[arg(long, value_name = "WHAT")]
    #[arg(value_parser = objectives(&["paper", "quality", "min-energy", "front"]))]
    pub(crate) objective: Option<Objective>,
    #[command(flatten)]
    pub(crate) planning: Planning,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) mission: MissionArg,
    /// Objective of the plan: the paper's rule, the most quality, or the least energy
    /// [default: that of the mission file, else quality]
    #[arg(long, value_name = "WHAT")]
    #[arg(value_parser = objectives(&["paper", "quality", "min-energy"]))]
    pub(crate) objective: Option<Objective>,
    #[command(flatten)]
    pub(crate) planning: Planning,
    /// The seed of all random numbers; of missions under supervisors people in the plane alone are
    /// drawn [default: that of the mission file, else 0]
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX))]
    pub(crate) seed: Option<u64>,
    /// Faults of the run: none (`none`), those of the mission file (`script`), or a file of faults
    #[arg(long, value_name = "none|script|FILE", default_value = "script")]
    pub(crate) faults: String,
    /// How often margins are checked, in ms [default: as the mission file says]
    #[arg(long, value_name = "ms", value_parser = duration)]
    pub(crate) monitor_period: Option<u64>,
    /// Also looks for better plans when the margins have grown
    #[arg(long)]
    pub(crate) upward: bool,
    /// How closely the robot is modelled; `plane` is for robots with a file
    #[arg(long, value_enum, value_name = "HOW", default_value_t = Fidelity::Line)]
    pub(crate) fidelity: Fidelity,
    /// Finds failures as runs by signals have: a file of `cotama fmeca --measure`, or the name of
    /// a robot that comes measured, `p3dx-delivery`; the seed draws [default: latencies as assumed]
    #[arg(long, value_name = "FILE")]
    pub(crate) measured: Option<String>,
    /// Holds back what the rest of the mission may take: a file of `cotama risk calibrate`; the
    /// mission is planned again when what is left is less, and the run says whether it kept within;
    /// or `none` [default: as the mission file says, else nothing beside the plan]
    #[arg(long, value_name = "none|FILE")]
    pub(crate) margins: Option<String>,
    /// Writes what each activity took, as CSV, for `cotama risk calibrate`
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) activities: Option<PathBuf>,
    /// Who answers where supervisors ask the operator: he of the script, or you
    #[arg(long, value_enum, value_name = "WHO", default_value_t = OperatorName::Script)]
    pub(crate) operator: OperatorName,
    /// How many people walk between the places of the floor, in the plane, in place of `people` of
    /// the mission; the seed draws them
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole(0, 1_000))]
    pub(crate) people: u64,
    /// The folder of the report, `index.html` [default: report/NAME]
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
    /// Writes no report
    #[arg(long, conflicts_with = "report")]
    pub(crate) no_report: bool,
    /// Writes the trace of the run, as JSON lines
    #[arg(long, value_name = "FILE.jsonl")]
    pub(crate) trace: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) recording: RecordingArgs,
    #[command(flatten)]
    pub(crate) json: Json,
    #[command(flatten)]
    pub(crate) team: TeamArgs,
    #[command(flatten)]
    pub(crate) ways: WaysArgs,
}

impl RunArgs {
    /// The first option given that only missions understand; the seed and files of the run aside.
    pub(crate) fn first_of_missions(&self) -> Option<&'static str> {
        let given = [
            ("--objective", self.objective.is_some()),
            ("--faults FILE", !["none", "script"].contains(&self.faults.as_str())),
            ("--monitor-period", self.monitor_period.is_some()),
            ("--upward", self.upward),
            ("--fidelity", self.fidelity != Fidelity::Line),
            ("--measured", self.measured.is_some()),
            ("--margins", self.margins.is_some()),
            ("--activities", self.activities.is_some()),
            ("--operator", self.operator != OperatorName::Script),
            ("--people", self.people > 0),
            ("--report", self.report.is_some()),
            ("--trace", self.trace.is_some()),
            ("--steps", self.planning.steps != STEPS),
        ];
        let given = given.into_iter().find(|it| it.1).map(|it| it.0);
        self.planning.first().or(given)
    }
}

#[derive(Args, Debug)]
pub(crate) struct AllocateArgs {
    /// The instance, a JSON file, or `-`
    pub(crate) instance: String,
    /// Objective of the plan: the most quality, or the least energy within both limits
    #[arg(long, value_name = "WHAT", default_value = "quality",
          value_parser = objectives(&["quality", "min-energy"]))]
    pub(crate) objective: Objective,
    /// Planner: a complete search, or the rule of PANORAMA, which pursues no objective
    #[arg(long, value_enum, value_name = "WHO", default_value_t = AllocatorName::Exact)]
    pub(crate) allocator: AllocatorName,
    /// The most steps of a complete search
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    #[arg(value_parser = whole(1, u64::MAX))]
    pub(crate) steps: u64,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct ReplayArgs {
    /// A trace, or a file of faults as a campaign writes it for each failure
    pub(crate) file: String,
    /// The mission of a file of faults: its name, or the path of its file [default: the one that
    /// the file names]
    #[arg(long)]
    pub(crate) mission: Option<String>,
    /// The seed for a file of faults [default: that of the file, else 0]
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX))]
    pub(crate) seed: Option<u64>,
    /// Writes a report of the run made again, `index.html`, to this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
    /// Writes the trace of the run made again, as JSON lines
    #[arg(long, value_name = "FILE.jsonl")]
    pub(crate) trace: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) recording: RecordingArgs,
    #[command(flatten)]
    pub(crate) json: Json,
}

/// The planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AllocatorName {
    /// A complete search; for the objective paper, only where the rule finds nothing
    Exact,
    /// The rule of PANORAMA: fast, can miss a plan, pursues no objective
    Panorama,
}

/// The operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum OperatorName {
    /// The mission's or the file's answers, and habits where they say nothing
    Script,
    /// You: at each request the situation is shown, over a floor as a picture, and a line of
    /// standard input answers it, as `Teleoperation done`
    Ask,
}

/// How closely the robot is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Fidelity {
    /// A point on its path
    Line,
    /// Two wheels that follow the path over a floor; of a mission that names none, along corridors
    Plane,
    /// The same by signals: nothing is told about poses and failures but what devices read
    Signal,
}

impl From<Fidelity> for cotama_sim::options::Fidelity {
    fn from(it: Fidelity) -> Self {
        match it {
            Fidelity::Line => Self::Line,
            Fidelity::Plane => Self::Plane,
            Fidelity::Signal => Self::Signal,
        }
    }
}

/// The objective of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Objective {
    /// The rule of PANORAMA: the highest plan that meets the limits
    Paper,
    /// The most quality
    Quality,
    /// The least energy
    MinEnergy,
    /// All plans of which none is better in duration, energy and quality
    Front,
}

impl Objective {
    /// Returns the name on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Quality => "quality",
            Self::MinEnergy => "min-energy",
            Self::Front => "front",
        }
    }
}

pub(super) fn objectives(
    names: &'static [&'static str],
) -> impl TypedValueParser<Value = Objective> {
    PossibleValuesParser::new(names).try_map(|name| Objective::from_str(&name, false))
}

/// Hardware lost from the start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Lost {
    /// The kind, not yet looked up.
    pub(crate) kind: String,
    /// The units; all if none.
    pub(crate) units: Option<u8>,
}

fn lost(text: &str) -> Result<Lost, String> {
    let (kind, units) = match text.rsplit_once(':') {
        None => (text, None),
        Some((kind, units)) => match units.parse() {
            Ok(units @ 1..) => (kind, Some(units)),
            _ => return Err(format!("`{units}` is not a number of units from 1 to 255")),
        },
    };
    if kind.is_empty() {
        return Err("a kind of hardware is missing before the colon".into());
    }
    Ok(Lost { kind: kind.into(), units })
}
