//! The results of a campaign: a header, lines, and counts over them.

use crate::requirements::Requirements;
use crate::run::{Line, MAX_FAULTS, MAX_RUNS, MAX_SHARDS, Settings, Shard};
use crate::space::Rates;
use crate::strategy::StrategyName;
use cotama_sim::options::{Fidelity, Planner};
use cotama_sim::run::Outcome;
use cotama_sim::trace::{FloorText, RobotText};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// The schema of [`Header`].
pub const SCHEMA: &str = "cotama-campaign/1";

/// The settings of a campaign, as a file beside its results: all that they depend on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// [`SCHEMA`].
    pub schema: String,
    /// The version of the program.
    pub version: String,
    /// The name of the mission's source.
    pub mission_source: String,
    /// The whole text of the mission file.
    pub mission: String,
    /// The file of the robot whose supervisors decide; `None` where none does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<RobotText>,
    /// The files of a team's robots that are not shipped.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub robots: Vec<RobotText>,
    /// The floor that the mission goes over; `None` where it names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<FloorText>,
    /// Number of runs.
    pub runs: u64,
    /// The seed of all draws.
    pub seed: u64,
    /// How plans are drawn.
    pub strategy: String,
    /// How kinds of faults are weighted.
    pub rates: String,
    /// The fewest and the most faults of a plan.
    pub faults: (u64, u64),
    /// Requirements of every run.
    pub requirements: Requirements,
    /// How plans are adapted.
    pub policy: String,
    /// Planner of the runs; as the mission file and the policy say if `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub planner: Option<Planner>,
    /// How closely the robot is modelled.
    #[serde(default, skip_serializing_if = "Fidelity::is_line")]
    pub fidelity: Fidelity,
    /// Which part of the runs these are.
    pub shard: Shard,
}

impl Header {
    /// The header of a campaign; `policy` is the name of how plans are adapted, by the planner of
    /// the mission or of that policy.
    pub fn new(
        (mission_source, mission): (&str, &str),
        settings: &Settings,
        policy: &str,
        shard: Shard,
    ) -> Self {
        Self {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            mission_source: mission_source.into(),
            mission: mission.into(),
            robot: None,
            robots: Vec::new(),
            floor: None,
            runs: settings.runs,
            seed: settings.seed,
            strategy: settings.strategy.name().into(),
            rates: settings.rates.name().into(),
            faults: settings.faults,
            requirements: settings.requirements.clone(),
            policy: policy.into(),
            planner: None,
            fidelity: Fidelity::Line,
            shard,
        }
    }

    /// Returns the settings of the campaign.
    ///
    /// # Errors
    /// A [`NotSettings`] that says which of its fields is beyond what a campaign takes.
    pub fn settings(&self) -> Result<Settings, NotSettings> {
        let strategy = StrategyName::ALL.into_iter().find(|it| it.name() == self.strategy);
        let strategy = strategy.ok_or_else(|| NotSettings::Strategy(self.strategy.clone()))?;
        let rates = Rates::ALL.into_iter().find(|it| it.name() == self.rates);
        let rates = rates.ok_or_else(|| NotSettings::Rates(self.rates.clone()))?;
        if !(1..=MAX_RUNS).contains(&self.runs) {
            return Err(NotSettings::Runs(self.runs));
        }
        let (least, most) = self.faults;
        if least > most || !(1..=MAX_FAULTS).contains(&most) {
            return Err(NotSettings::Faults(least, most));
        }
        let Shard { index, of } = self.shard;
        if !(1..=of).contains(&index) || of > MAX_SHARDS {
            return Err(NotSettings::Shard(index, of));
        }
        let (runs, seed, faults) = (self.runs, self.seed, self.faults);
        let requirements = self.requirements.clone();
        Ok(Settings { runs, seed, strategy, rates, faults, requirements })
    }

    /// The digest of all that results depend on: equal for the shards of one campaign, and wherever
    /// its mission was read from.
    pub fn digest(&self) -> Digest {
        let key = Self { shard: Shard::ALL, mission_source: String::new(), ..self.clone() };
        let mut digest = Digest::default();
        digest.add(serde_json::to_string(&key).unwrap_or_default().as_bytes());
        digest
    }

    /// In what this differs from another header, but for the shard: the name of the first field.
    pub fn differs_from(&self, other: &Self) -> Option<&'static str> {
        let differ = [
            ("schema", self.schema != other.schema),
            ("version", self.version != other.version),
            ("mission", self.mission != other.mission),
            ("runs", self.runs != other.runs),
            ("seed", self.seed != other.seed),
            ("strategy", self.strategy != other.strategy),
            ("rates", self.rates != other.rates),
            ("faults", self.faults != other.faults),
            ("requirements", self.requirements != other.requirements),
            ("policy", self.policy != other.policy),
            ("planner", self.planner != other.planner),
            ("fidelity", self.fidelity != other.fidelity),
            ("shard", self.shard.of != other.shard.of),
        ];
        differ.into_iter().find(|it| it.1).map(|it| it.0)
    }
}

/// Why a header asks for no campaign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotSettings {
    /// No strategy is called so.
    Strategy(String),
    /// No rates are called so.
    Rates(String),
    /// The number of runs is zero, or more than [`MAX_RUNS`].
    Runs(u64),
    /// From more to fewer faults, to none, or to more than [`MAX_FAULTS`].
    Faults(u64, u64),
    /// The number of the shard is not one of the shards, or they are more than [`MAX_SHARDS`].
    Shard(u64, u64),
}

impl fmt::Display for NotSettings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Strategy(it) => write!(f, "there is no strategy `{}`", it.escape_debug()),
            Self::Rates(it) => write!(f, "there are no rates `{}`", it.escape_debug()),
            Self::Runs(it) => write!(f, "{it} runs: from 1 to {MAX_RUNS} are run"),
            Self::Faults(least, most) => {
                write!(f, "{least} to {most} faults: a run has up to {MAX_FAULTS}")
            }
            Self::Shard(index, of) if *of > MAX_SHARDS => {
                write!(f, "shard {index}/{of}: there are at most {MAX_SHARDS}")
            }
            Self::Shard(index, of) => {
                write!(f, "shard {index}/{of}: its number is not one of the shards")
            }
        }
    }
}

impl std::error::Error for NotSettings {}

/// A digest of lines, in their order: FNV-1a of 128 bits. It finds what differs by chance, not what
/// somebody made to deceive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u128);

impl Default for Digest {
    fn default() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Digest {
    /// Takes some bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            let mixed = self.0 ^ u128::from(byte);
            self.0 = mixed.wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b);
        }
    }

    /// As 32 hexadecimal digits.
    pub fn hex(self) -> String {
        format!("{:032x}", self.0)
    }
}

/// The most failing runs that are kept of one requirement, to be shrunk.
pub const MOST_KEPT: usize = 200;

/// Counts over lines, in the order of runs.
///
/// ```
/// use cotama_campaign::results::Tally;
/// let line = r#"{"run":0,"outcome":"safe","time_ms":5,"energy_mj":7,"x_mm":9,"requests":1,
///     "replans":0,"exposed_ms":0,"faults":["SON2@Following"],"violated":["completed"]}"#;
/// let mut tally = Tally::default();
/// tally.add(&serde_json::from_str(line).unwrap(), line);
/// assert_eq!((tally.runs, tally.violated["completed"]), (1, 1));
/// assert_eq!(tally.cells["SON2@Following"], (1, 1));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Number of runs.
    pub runs: u64,
    /// How many ended how, in the order completed, safe, failed.
    pub outcomes: [u64; 3],
    /// How many broke each requirement.
    pub violated: BTreeMap<String, u64>,
    /// How many broke any.
    pub failing: u64,
    /// In how many runs something went wrong in some place, and how many of them broke a
    /// requirement.
    pub cells: BTreeMap<String, (u64, u64)>,
    /// Sums: time in ms, energy in mJ, requests.
    pub sums: [u128; 3],
    /// The first [`MOST_KEPT`] lines that broke each requirement.
    pub kept: BTreeMap<String, Vec<Line>>,
    /// How many had failed after how many runs, at eight numbers of runs up to each doubling.
    pub course: Vec<(u64, u64)>,
    /// By the metre in which runs ended: how many that broke a requirement, and how many others
    /// that were not completed.
    pub ended: BTreeMap<u64, (u64, u64)>,
    digest: Digest,
}

impl Tally {
    /// Counts a line, which reads as `text`.
    pub fn add(&mut self, line: &Line, text: &str) {
        self.digest.add(text.as_bytes());
        self.digest.add(b"\n");
        self.runs += 1;
        self.outcomes[match line.observed.outcome {
            Outcome::Completed => 0,
            Outcome::Safe => 1,
            Outcome::Failed => 2,
        }] += 1;
        let failed = !line.violated.is_empty();
        self.failing += u64::from(failed);
        let mut cells = line.faults.clone();
        cells.sort();
        cells.dedup();
        for cell in cells {
            let (met, failing) = self.cells.entry(cell).or_default();
            *met += 1;
            *failing += u64::from(failed);
        }
        for (sum, it) in self.sums.iter_mut().zip([
            line.observed.time_ms,
            line.observed.energy_mj,
            line.observed.requests,
        ]) {
            *sum += u128::from(it);
        }
        for requirement in &line.violated {
            let requirement = requirement.to_string();
            *self.violated.entry(requirement.clone()).or_default() += 1;
            let kept = self.kept.entry(requirement).or_default();
            if kept.len() < MOST_KEPT {
                kept.push(line.clone());
            }
        }
        if failed || line.observed.outcome != Outcome::Completed {
            let (failing, others) = self.ended.entry(line.observed.x_mm / 1_000).or_default();
            *if failed { failing } else { others } += 1;
        }
        // From 8 on the first four bits of the number change.
        let step = 1_u64 << self.runs.ilog2().saturating_sub(3);
        if self.runs.is_multiple_of(step) {
            self.course.push((self.runs, self.failing));
        }
    }

    /// The digest of all lines.
    pub fn digest(&self) -> String {
        self.digest.hex()
    }
}
