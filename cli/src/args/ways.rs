//! The options of `cotama run two-ways`.

use super::number::whole;
use super::risk::{ChoiceRuleName, MemoryName};
use clap::{Args, ValueEnum};
use cotama_ways::{ObjectSpeed, Policy};
use std::path::PathBuf;

#[derive(Args, Clone, Debug)]
pub(crate) struct WaysArgs {
    /// A policy of `two-ways`: `short`, `long`, `random`, `defensive`, `mean`, or the level of a
    /// quantile; may be repeated [default: random, defensive, mean, 0.5, 0.75]
    #[arg(long, value_name = "POLICY", value_parser = policy)]
    pub(crate) policy: Vec<Policy>,
    /// How fast the discs of `two-ways` move: 0.15, 0.3 or 0.6 m/s [default: medium]
    #[arg(long, value_enum, value_name = "SPEED")]
    pub(crate) object_speed: Option<SpeedName>,
    /// How many runs of 40 maps each policy of `two-ways` makes; all meet the same discs [default:
    /// 1]
    #[arg(long, value_name = "N", value_parser = whole(1, 1_000))]
    pub(crate) runs: Option<u64>,
    /// Rule of `two-ways` for later trials [default: thesis]
    #[arg(long, value_enum, value_name = "RULE")]
    pub(crate) rule: Option<ChoiceRuleName>,
    /// Rule of `two-ways` by which failed trials change the belief [default: sum]
    #[arg(long, value_enum, value_name = "RULE")]
    pub(crate) memory: Option<MemoryName>,
    /// Goes on learning in `two-ways`: each map adds its trials, from run to run
    #[arg(long)]
    pub(crate) online: bool,
    /// Writes the network that `two-ways` learned at first
    #[arg(long, value_name = "FILE.bif")]
    pub(crate) learned: Option<PathBuf>,
    /// Draws a map of `two-ways` with the trials of the first policy
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// The map that is drawn [default: 1]
    #[arg(long, value_name = "N", value_parser = whole(1, 20), requires = "svg")]
    pub(crate) map: Option<u64>,
}

impl WaysArgs {
    /// The first of these options that was given.
    pub(crate) fn first(&self) -> Option<&'static str> {
        let given = [
            ("--policy", !self.policy.is_empty()),
            ("--object-speed", self.object_speed.is_some()),
            ("--runs", self.runs.is_some()),
            ("--rule", self.rule.is_some()),
            ("--memory", self.memory.is_some()),
            ("--online", self.online),
            ("--learned", self.learned.is_some()),
            ("--svg", self.svg.is_some()),
        ];
        given.into_iter().find(|it| it.1).map(|it| it.0)
    }
}

/// A speed of discs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SpeedName {
    Slow,
    Medium,
    Fast,
}

impl From<SpeedName> for ObjectSpeed {
    fn from(it: SpeedName) -> Self {
        match it {
            SpeedName::Slow => Self::Slow,
            SpeedName::Medium => Self::Medium,
            SpeedName::Fast => Self::Fast,
        }
    }
}

fn policy(text: &str) -> Result<Policy, String> {
    Policy::of(text).ok_or_else(|| {
        "`short`, `long`, `random`, `defensive`, `mean`, or a number between 0 and 1".to_owned()
    })
}
