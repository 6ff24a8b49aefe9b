//! What the runs of a campaign come to: a header, lines, and what is counted of them.

use super::run::{Line, Settings, Shard};
use super::space::Rates;
use super::statistics::{Interval, clopper_pearson};
use super::strategy::StrategyName;
use crate::run::Outcome;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The schema of [`Header`].
pub const SCHEMA: &str = "cotama-campaign/1";

/// What a campaign runs, as a file beside its results: all that they depend on.
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
    /// How many runs.
    pub runs: u64,
    /// The seed of all draws.
    pub seed: u64,
    /// How plans are drawn.
    pub strategy: String,
    /// How kinds of faults are weighted.
    pub rates: String,
    /// The fewest and the most faults of a plan.
    pub faults: (u64, u64),
    /// What must hold.
    pub requirements: Vec<String>,
    /// Who plans.
    pub policy: String,
    /// Which part of the runs these are.
    pub shard: Shard,
}

impl Header {
    /// The header of a campaign; `policy` is the name of who plans.
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
            runs: settings.runs,
            seed: settings.seed,
            strategy: settings.strategy.name().into(),
            rates: settings.rates.name().into(),
            faults: settings.faults,
            requirements: settings.requirements.iter().map(ToString::to_string).collect(),
            policy: policy.into(),
            shard,
        }
    }

    /// What was drawn and asked; none for a header that names something unknown.
    pub fn settings(&self) -> Option<Settings> {
        let strategy = StrategyName::ALL.into_iter().find(|it| it.name() == self.strategy)?;
        let rates = [Rates::Even, Rates::Fmeca].into_iter().find(|it| it.name() == self.rates)?;
        let requirements =
            self.requirements.iter().map(|it| it.parse().ok()).collect::<Option<_>>();
        let (seed, faults) = (self.seed, self.faults);
        Some(Settings {
            runs: self.runs,
            seed,
            strategy,
            rates,
            faults,
            requirements: requirements?,
        })
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
            ("shard", self.shard.of != other.shard.of),
        ];
        differ.into_iter().find(|it| it.1).map(|it| it.0)
    }
}

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

/// What is counted of lines, in the order of runs.
///
/// ```
/// use cotama_sim::campaign::results::Tally;
/// let line = r#"{"run":0,"outcome":"safe","time_ms":5,"energy_mj":7,"x_mm":9,"requests":1,
///     "replans":0,"exposed_ms":0,"faults":["SON2@Following"],"violated":["completed"]}"#;
/// let mut tally = Tally::default();
/// tally.add(&serde_json::from_str(line).unwrap(), line);
/// assert_eq!((tally.runs, tally.violated["completed"]), (1, 1));
/// assert_eq!(tally.cells["SON2@Following"], (1, 1));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// How many runs.
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
    /// How many had failed after how many runs, at powers of two and at the end.
    pub course: Vec<(u64, u64)>,
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
            *self.violated.entry(requirement.clone()).or_default() += 1;
            let kept = self.kept.entry(requirement.clone()).or_default();
            if kept.len() < MOST_KEPT {
                kept.push(line.clone());
            }
        }
        if self.runs.is_power_of_two() {
            self.course.push((self.runs, self.failing));
        }
    }

    /// The digest of all lines.
    pub fn digest(&self) -> String {
        self.digest.hex()
    }

    /// The interval for the probability that a requirement is broken, of plans drawn as these were.
    pub fn probability(&self, requirement: &str, confidence: f64) -> Interval {
        let hits = self.violated.get(requirement).copied().unwrap_or(0);
        clopper_pearson(hits, self.runs, confidence)
    }
}
