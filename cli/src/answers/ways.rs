//! The answer of `cotama run two-ways`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama run two-ways`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct WaysAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/run-two-ways/1")))]
    pub(crate) schema: &'static str,
    pub(crate) seed: u64,
    /// Runs of each policy, 40 maps each.
    pub(crate) runs: u64,
    /// Speed of the discs, in m/s.
    pub(crate) object_speed: f64,
    /// `thesis`, `exact` or `total`.
    pub(crate) rule: &'static str,
    /// `sum` or `product`.
    pub(crate) memory: &'static str,
    /// Whether trials of the runs were learned from.
    pub(crate) online: bool,
    /// Failed trials of the training, by ratio and way.
    pub(crate) training: Vec<TrainingRow>,
    pub(crate) policies: Vec<WaysPolicyRow>,
}

/// Trials of the training on a way at a ratio.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TrainingRow {
    pub(crate) ratio: &'static str,
    pub(crate) way: &'static str,
    /// Share of trials that failed.
    pub(crate) failed: ShareRow,
}

/// A share with its exact interval of 95 %.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ShareRow {
    pub(crate) share: f64,
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Number of cases.
    pub(crate) of: u64,
}

/// A mean per map, with its interval of 95 % over runs if there are two or more.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MeanRow {
    pub(crate) mean: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) low: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) high: Option<f64>,
}

/// Results of a policy.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct WaysPolicyRow {
    pub(crate) policy: String,
    /// Reward per map.
    pub(crate) reward: MeanRow,
    /// How much more it is than that of the first policy, by pairs of runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) gain: Option<MeanRow>,
    /// Share of estimates that the reward reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) reliability: Option<ShareRow>,
    pub(crate) conditions: Vec<ConditionRow>,
}

/// Results in a condition.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ConditionRow {
    /// `limited` or `overview`.
    pub(crate) condition: &'static str,
    /// Failed trials per map, from 0 to 3.
    pub(crate) errors: MeanRow,
    pub(crate) reward: MeanRow,
    /// Reward, had the robot left maps at the first estimate below 0.
    pub(crate) reward_with_stops: MeanRow,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) reliability: Option<ShareRow>,
    /// Mean square error of the estimate over the variance of the reward.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) relative_error: Option<f64>,
    /// Share of second trials on the other way, at 3/1 and 5/1.
    pub(crate) switched: ShareRow,
    /// Share of changes of way that led to fewer discs.
    pub(crate) to_fewer: ShareRow,
    pub(crate) ratios: Vec<RatioRow>,
}

/// Results at a ratio.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RatioRow {
    pub(crate) ratio: &'static str,
    pub(crate) errors: MeanRow,
    pub(crate) reward: MeanRow,
    /// How often the first trial took the short way.
    pub(crate) short_first: u64,
    pub(crate) maps: u64,
}
