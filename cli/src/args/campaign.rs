//! The command line of `cotama campaign`.

use super::mission::{Fidelity, objectives};
use super::number::whole;
use super::{AllocatorName, Json, Objective, STEPS};
use crate::exit::Failure;
use crate::mission;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use cotama_campaign::requirement::Requirement;
use cotama_campaign::run::{MAX_FAULTS, MAX_RUNS, MAX_SHARDS, Shard};
use cotama_campaign::space::Rates;
use cotama_campaign::strategy::StrategyName;
use cotama_campaign::subject::Policy;
use cotama_models::missions::Mission;
use cotama_sim::options::{Aim, Planner};
use std::path::PathBuf;

pub(super) const CAMPAIGN_EXAMPLES: &str = "\
Requirements (--require, repeated) completed; not-failed; METRIC<=N with time (ms) or energy (mJ), \
of teams also robot-time (ms), put-up-again, failed-uses; under supervisors in-time, brakes, \
stands-when-safe, seen-in-time, plans-with-what-works, requests<=N, exposed<=N (ms), `never \
NET.TRANSITION`, and properties as of `cotama check` that one run can break: `AG (gs.Safe -> \
ls.Idle)`, `AG (p -> AF<=200ms q)`. Usual: in-time, brakes and stands-when-safe, or not-failed \
without supervisors.

Examples:
  $ cotama campaign patrol --runs 200
  $ cotama campaign delivery --runs 200 --strategy swarm --out found
  $ cotama campaign delivery --runs 1000 --shard 1/2 --out part1
  $ cotama campaign delivery --runs 1000 --shard 2/2 --out part2
  $ cotama campaign merge part1 part2 --out whole
  $ cotama campaign patrol --runs 5000 --require completed --at-most 0.9
  $ cotama campaign patrol --runs 200 --compare
  $ cotama campaign patrol --rates drift --policy rigid --activities runs.csv";

#[derive(Args, Debug)]
pub(crate) struct CampaignArgs {
    /// The name of a mission that comes with the program, the path of a mission file, or `merge`
    pub(crate) scenario: String,
    /// After `merge`: the folders of all shards
    #[arg(value_name = "DIR")]
    pub(crate) shards: Vec<PathBuf>,
    /// How many missions are run [default: 1000]
    #[arg(long, value_name = "N", value_parser = whole(1, MAX_RUNS))]
    pub(crate) runs: Option<u64>,
    /// On how many threads [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = whole(1, 1_024))]
    pub(crate) jobs: Option<u64>,
    /// The seed of all draws [default: 0]
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX))]
    pub(crate) seed: Option<u64>,
    /// How plans of faults are drawn [default: uniform]
    #[arg(long, value_name = "HOW", value_parser = strategies())]
    pub(crate) strategy: Option<StrategyName>,
    /// Which faults are likely: all alike (`even`), by the FMECA (`fmeca`, under supervisors), or
    /// obstacles, odometry and power alone (`drift`, without supervisors) [default: even]
    #[arg(long, value_name = "HOW", value_parser = rates())]
    pub(crate) rates: Option<Rates>,
    /// How many faults a run has, as `2` or `1..3` [default: 1..3]
    #[arg(long, value_name = "N[..N]", value_parser = per_run)]
    pub(crate) per_run: Option<(u64, u64)>,
    /// Requirement of every run
    #[arg(long, value_name = "WHAT", value_parser = requirement)]
    pub(crate) require: Vec<Requirement>,
    /// How plans are adapted; with `exact` also who makes them [default: usual]
    #[arg(long, value_enum, value_name = "HOW")]
    pub(crate) policy: Option<PolicyName>,
    /// A plain mission under the supervisors of a robot, as in `cotama run`
    #[arg(long, value_name = "ROBOT", num_args = 0..=1, default_missing_value = "")]
    pub(crate) supervised: Option<String>,
    /// How closely the robot is modelled, as in `cotama run`
    #[arg(long, value_enum, value_name = "HOW", default_value_t = Fidelity::Line)]
    pub(crate) fidelity: Fidelity,
    /// Finds failures as runs by signals have, as in `cotama run`; each run draws
    #[arg(long, value_name = "FILE", conflicts_with_all = ["compare", "out", "shard"])]
    pub(crate) measured: Option<String>,
    /// Holds back what the rest of the mission may take, as in `cotama run`, says how often runs
    /// passed it, and whether the promise holds; goes without --compare, --out and --shard
    #[arg(long, value_name = "none|FILE")]
    pub(crate) margins: Option<String>,
    /// Writes what each activity of each run took, as CSV, for `cotama risk calibrate`; of at most
    /// 100000 runs
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["compare", "out", "shard"])]
    pub(crate) activities: Option<PathBuf>,
    /// Writes ten indicators of each run in the plane, two rows a second one run after the other,
    /// as CSV with the columns of `cotama risk observe`; of at most 1000 runs
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["compare", "out", "shard"])]
    pub(crate) indicators: Option<PathBuf>,
    /// Objective of the plan, as in `cotama run`: the paper's rule, the most quality, or the least
    /// energy [default: that of the mission file, else quality]
    #[arg(long, value_name = "WHAT", conflicts_with = "compare")]
    #[arg(value_parser = objectives(&["paper", "quality", "min-energy"]))]
    pub(crate) objective: Option<Objective>,
    /// Planner, as in `cotama run`: the rule of PANORAMA, or a complete search
    /// [default: panorama for the objective paper, else exact]
    #[arg(long, value_enum, value_name = "WHO", conflicts_with = "compare")]
    pub(crate) allocator: Option<AllocatorName>,
    /// The most steps of a complete search
    #[arg(long, value_name = "N", default_value_t = STEPS, value_parser = whole(1, u64::MAX))]
    pub(crate) steps: u64,
    /// Runs the same plans with each policy, and compares how they end
    #[arg(long, conflicts_with_all = ["shard", "out", "at_most", "within", "policy"])]
    #[arg(conflicts_with_all = ["require", "shrink", "junit"])]
    pub(crate) compare: bool,
    /// Stops as soon as it is decided whether the probability of failure is at most this, or at
    /// least twice this (but less than half way to 1)
    #[arg(long, value_name = "P", value_parser = share, conflicts_with = "shard")]
    pub(crate) at_most: Option<f64>,
    /// Runs so many missions that the estimate misses by at most this
    #[arg(long, value_name = "E", value_parser = share, conflicts_with_all = ["runs", "at_most"])]
    pub(crate) within: Option<f64>,
    /// How often an interval holds the truth, or a decision is right, at least [default: 0.95]
    #[arg(long, value_name = "C", value_parser = confidence)]
    pub(crate) confidence: Option<f64>,
    /// How many failing runs of each requirement are made small [default: 20, of a shard none]
    #[arg(long, value_name = "N", value_parser = whole(0, 200))]
    pub(crate) shrink: Option<u64>,
    /// Runs one part of the campaign, as `2/3`: merge them with `cotama campaign merge`
    #[arg(long, value_name = "I/N", value_parser = shard, requires = "out")]
    pub(crate) shard: Option<Shard>,
    /// The folder of results, failures and the report; a campaign that was stopped goes on there
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Writes the requirements as test cases, in the XML of JUnit
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}

/// How plans are adapted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PolicyName {
    /// When a margin is below zero or what a plan needs is lost, as `cotama run` does
    Usual,
    /// The same, by the rule of PANORAMA and a complete search where it finds nothing; under
    /// supervisors by a complete search for the most quality
    Exact,
    /// As usual, and to better plans when margins have grown
    Upward,
    /// The plan of the start is kept
    Rigid,
}

impl CampaignArgs {
    /// How often an interval holds the truth.
    pub(crate) fn confidence(&self) -> f64 {
        self.confidence.unwrap_or(0.95)
    }

    /// Returns the planner of the runs.
    pub(crate) fn policy(&self) -> PolicyName {
        self.policy.unwrap_or(PolicyName::Usual)
    }
}

impl PolicyName {
    /// All, the one without adaptation first.
    pub(crate) const ALL: [Self; 4] = [Self::Rigid, Self::Usual, Self::Exact, Self::Upward];

    /// Returns the name on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Usual => "usual",
            Self::Exact => "exact",
            Self::Upward => "upward",
            Self::Rigid => "rigid",
        }
    }

    /// The policy, of a mission with supervisors or without; by the mission's own planner but for
    /// `exact`.
    pub(crate) fn policy(self, supervised: bool, steps: u64) -> Policy {
        let exact = if supervised {
            Planner::Exact { aim: Aim::Quality, steps }
        } else {
            Planner::PanoramaThenExact { steps }
        };
        let (planner, upward, rigid) = match self {
            Self::Usual => (None, false, false),
            Self::Exact => (Some(exact), false, false),
            Self::Upward => (None, true, false),
            Self::Rigid => (None, false, true),
        };
        Policy { planner, upward, rigid, ..Policy::default() }
    }
}

impl CampaignArgs {
    /// Returns the planner and the policy for this mission.
    ///
    /// # Errors
    /// A [`Failure`] where steps are given and nothing is searched.
    pub(crate) fn policy_for(&self, mission: &Mission) -> Result<Policy, Failure> {
        let given = [
            ("--objective", self.objective.is_some()),
            ("--allocator", self.allocator.is_some()),
            ("--margins", crate::margins::are_given(self.margins.as_deref())),
        ];
        mission::beside_wishes(mission, &given)?;
        let policy = self.policy().policy(mission.is_supervised(), self.steps);
        let policy = Policy { fidelity: self.fidelity.into(), ..policy };
        if policy.planner.is_some() {
            return Ok(policy);
        }
        let objective = mission::objective(self.objective, self.allocator, mission);
        let chosen = mission::planner(objective, self.allocator, self.steps)?;
        Ok(Policy { planner: Some(chosen), ..policy })
    }
}

fn strategies() -> impl TypedValueParser<Value = StrategyName> {
    PossibleValuesParser::new(StrategyName::ALL.map(StrategyName::name)).map(|name| {
        let found = StrategyName::ALL.into_iter().find(|it| it.name() == name);
        found.unwrap_or(StrategyName::Uniform)
    })
}

fn rates() -> impl TypedValueParser<Value = Rates> {
    PossibleValuesParser::new(Rates::ALL.map(Rates::name)).map(|name| {
        let found = Rates::ALL.into_iter().find(|it| it.name() == name);
        found.unwrap_or(Rates::Even)
    })
}

fn requirement(text: &str) -> Result<Requirement, String> {
    text.parse().map_err(|error: cotama_campaign::requirement::NoRequirement| error.to_string())
}

fn per_run(text: &str) -> Result<(u64, u64), String> {
    let (least, most) = text.split_once("..").unwrap_or((text, text));
    let number = |it: &str| it.parse().ok().filter(|it| *it <= MAX_FAULTS);
    let pair = number(least).zip(number(most)).filter(|it| it.0 <= it.1 && it.1 > 0);
    pair.ok_or_else(|| format!("a number from 1 to {MAX_FAULTS}, or a range as 1..3, is needed"))
}

fn shard(text: &str) -> Result<Shard, String> {
    let (index, of) = text.split_once('/').unwrap_or((text, ""));
    let shard = index.parse().ok().zip(of.parse().ok()).map(|(index, of)| Shard { index, of });
    let fits = |it: &Shard| (1..=it.of).contains(&it.index) && it.of <= MAX_SHARDS;
    shard.filter(fits).ok_or_else(|| "a part of the whole, as 2/3, is needed".into())
}

pub(super) fn share(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|it| *it > 1e-9 && *it < 1.0);
    number.ok_or_else(|| "a number between 0 and 1, as 0.01, is needed".into())
}

pub(super) fn confidence(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|it| (0.5..=0.999_999).contains(it));
    number.ok_or_else(|| "a number from 0.5 to 0.999999, as 0.95, is needed".into())
}
