//! Policies: rules by which a robot chooses its way.

use crate::maps::Ratio;
use crate::ring::Way;
use cotama_risk::{ChoiceRule, Measure, Memory, Model, Seen};
use cotama_streams::Stream;
use std::fmt;

/// A rule by which the way of a trial is chosen (Rohrmueller 2011, section 4.5.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Policy {
    /// Always the short way: for training.
    Short,
    /// Always the long way: for training.
    Long,
    /// Either, equally likely.
    Random,
    /// The way with fewer discs, the short one of equal ones; either, while these are not known.
    Defensive,
    /// The way of the higher reward by the learned model.
    Inference(Measure),
}

impl Policy {
    /// The five policies that the thesis compares.
    pub const COMPARED: [Self; 5] = [
        Self::Random,
        Self::Defensive,
        Self::Inference(Measure::Mean),
        Self::Inference(Measure::Quantile(0.5)),
        Self::Inference(Measure::Quantile(0.75)),
    ];

    /// The policy of this name: `short`, `long`, `random`, `defensive`, `mean`, or the level of a
    /// quantile, above 0 and below 1.
    ///
    /// ```
    /// use cotama_ways::Policy;
    /// assert_eq!(Policy::of("0.75").unwrap().to_string(), "0.75");
    /// assert!(Policy::of("1").is_none());
    /// ```
    pub fn of(name: &str) -> Option<Self> {
        Some(match name {
            "short" => Self::Short,
            "long" => Self::Long,
            "random" => Self::Random,
            "defensive" => Self::Defensive,
            "mean" => Self::Inference(Measure::Mean),
            level => {
                let level = level.parse().ok().filter(|it| *it > 0.0 && *it < 1.0)?;
                Self::Inference(Measure::Quantile(level))
            }
        })
    }
}

impl fmt::Display for Policy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Short => f.write_str("short"),
            Self::Long => f.write_str("long"),
            Self::Random => f.write_str("random"),
            Self::Defensive => f.write_str("defensive"),
            Self::Inference(Measure::Mean) => f.write_str("mean"),
            Self::Inference(Measure::Quantile(level)) => write!(f, "{level}"),
        }
    }
}

/// Knowledge of the discs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Condition {
    /// The ratio is not known.
    Limited,
    /// The ratio is told.
    Overview,
}

impl Condition {
    /// Both conditions, in the order of a run.
    pub const ALL: [Self; 2] = [Self::Limited, Self::Overview];

    /// The name of the condition.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Limited => "limited",
            Self::Overview => "overview",
        }
    }

    /// Belief at first.
    pub(crate) fn belief(self, ratio: Ratio) -> [f64; 5] {
        match self {
            Self::Limited => [0.2; 5],
            Self::Overview => Ratio::ALL.map(|it| f64::from(u8::from(it == ratio))),
        }
    }
}

/// Rules by which an estimate is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// Weights of later trials.
    pub choice: ChoiceRule,
    /// Change of the belief after failed trials.
    pub memory: Memory,
}

impl Default for Rules {
    /// Both as the thesis prints them.
    fn default() -> Self {
        Self { choice: ChoiceRule::Thesis, memory: Memory::Sum }
    }
}

/// Chooses the way of a trial after failed ones; with the estimated reward, if it is estimated.
pub(crate) fn choose(
    policy: Policy,
    rules: Rules,
    model: &Model,
    (condition, ratio): (Condition, Ratio),
    failed: &[Seen],
    chance: &mut Stream,
) -> (Way, Option<f64>) {
    let drawn = Way::ALL[chance.below(2) as usize];
    let way = match policy {
        Policy::Short => Way::Short,
        Policy::Long => Way::Long,
        Policy::Random => drawn,
        Policy::Defensive if condition == Condition::Limited => drawn,
        Policy::Defensive => {
            let [short, long] = ratio.discs();
            if long < short { Way::Long } else { Way::Short }
        }
        Policy::Inference(measure) => {
            let belief = model.belief(&condition.belief(ratio), failed, rules.memory);
            let left = model.trials().saturating_sub(failed.len());
            let estimate = model.estimate(&belief, left, measure, rules.choice);
            return (Way::ALL[estimate.way.min(1)], Some(estimate.reward));
        }
    };
    (way, None)
}
