//! The command line of `cotama estimate`.

use super::Json;
use super::campaign::{confidence, share};
use super::check::Semantics;
use super::number::whole;
use clap::Args;

pub(super) const ESTIMATE_EXAMPLES: &str = "\
Properties: AG p, EF p, AF p, EG p, A (p U q), E (p U q) of what is about one marking, as \
`cotama help check` lists it.

Examples:
  $ cotama estimate philosophers:8 --property 'EF deadlock' --steps 60 --runs 1000
  $ cotama estimate watchdog --untimed --property 'AG !Fault' --within 0.02   # exit code 1
  $ cotama estimate delivery --property 'EF ls.Following' --steps 2000 --runs 200 --json";

/// The most runs that are drawn.
pub(crate) const MOST_RUNS: u64 = 1_000_000_000;

#[derive(Args, Debug)]
pub(crate) struct EstimateArgs {
    /// The name of a model that comes with the program, the path of a PNML, JSON or TINA (.net)
    /// file, or `-`
    pub(crate) model: String,
    /// A property that one run can decide; any number of them
    #[arg(long, value_name = "TEXT", required = true)]
    pub(crate) property: Vec<String>,
    /// How many runs are drawn
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = whole(1, MOST_RUNS))]
    pub(crate) runs: u64,
    /// Draws so many runs that the estimate misses by at most this
    #[arg(long, value_name = "E", value_parser = share, conflicts_with = "runs")]
    pub(crate) within: Option<f64>,
    /// How often an interval holds the truth, at least
    #[arg(long, value_name = "C", default_value = "0.95", value_parser = confidence)]
    pub(crate) confidence: f64,
    /// The most transitions that a run fires
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = whole(0, 1 << 40))]
    pub(crate) steps: u64,
    /// The seed of all draws
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole(0, u64::MAX))]
    pub(crate) seed: u64,
    /// On how many threads [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = whole(1, 1_024))]
    pub(crate) jobs: Option<u64>,
    /// Leaves the intervals of transitions out: they fire in any order, at any time
    #[arg(long)]
    pub(crate) untimed: bool,
    /// Meaning of a system of nets [default: rounds]
    #[arg(long, value_enum, value_name = "MEANING")]
    pub(crate) semantics: Option<Semantics>,
    #[command(flatten)]
    pub(crate) json: Json,
}
