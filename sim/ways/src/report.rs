//! Results of runs, with intervals.

use crate::maps::Ratio;
use crate::policy::{Condition, Policy};
use crate::ring::Way;
use crate::run::Visit;
use cotama_campaign::statistics::{Interval, clopper_pearson, mean_interval, paired_difference};

/// Confidence of all intervals.
pub const CONFIDENCE: f64 = 0.95;

/// A mean over maps, and its interval over runs where there are two or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// Student's interval of the means of runs: maps of one run share what was learned.
    pub interval: Option<Interval>,
}

/// Results on the maps of a ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtRatio {
    /// The ratio.
    pub ratio: Ratio,
    /// Failed trials per map, from 0 to 3: the relative error rate of the thesis.
    pub errors: Mean,
    /// Reward per map.
    pub reward: Mean,
    /// How often the first trial took the short way.
    pub short_first: u64,
    /// Maps.
    pub maps: u64,
}

/// Results in a condition.
#[derive(Clone, Debug, PartialEq)]
pub struct InCondition {
    /// The condition.
    pub condition: Condition,
    /// Failed trials per map.
    pub errors: Mean,
    /// Reward per map.
    pub reward: Mean,
    /// The same with maps left at the first estimate below 0.
    pub reward_with_stops: Mean,
    /// Share of first estimates that the reward reached, with its exact interval; of policies that
    /// estimate.
    pub reliability: Option<Interval>,
    /// Mean square of estimate less reward, over the variance of the reward.
    pub relative_error: Option<f64>,
    /// Share of second trials that took the other way, on maps of 3/1 and 5/1.
    pub switched: Interval,
    /// How many second trials there were on these maps.
    pub second_trials: u64,
    /// Share of all such changes that led to the way with fewer discs, and their number.
    pub to_fewer: (Interval, u64),
    /// Results of each ratio.
    pub ratios: Vec<AtRatio>,
}

/// Results of a policy.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// The policy.
    pub policy: Policy,
    /// Number of runs.
    pub runs: u64,
    /// Reward per map over both conditions.
    pub reward: Mean,
    /// Share of first estimates that the reward reached, over both conditions.
    pub reliability: Option<Interval>,
    /// Results of each condition.
    pub conditions: Vec<InCondition>,
}

impl Results {
    /// The results of the runs of a policy.
    pub fn new(policy: Policy, runs: &[Vec<Visit>]) -> Self {
        let all = |_: &Visit| true;
        Self {
            policy,
            runs: runs.len() as u64,
            reward: mean(runs, all, Visit::reward),
            reliability: reliability(runs, all),
            conditions: Condition::ALL.map(|it| in_condition(runs, it)).to_vec(),
        }
    }
}

/// The difference of the reward per map, second less first, by pairs of runs; none for less than
/// two runs.
pub fn gain(first: &[Vec<Visit>], second: &[Vec<Visit>]) -> Option<Interval> {
    let rewards = |runs: &[Vec<Visit>]| of_runs(runs, |_| true, Visit::reward);
    let pairs: Vec<_> = rewards(first).into_iter().zip(rewards(second)).collect();
    (pairs.len() > 1).then(|| paired_difference(&pairs, CONFIDENCE))
}

/// For each run the mean of a number over its visits of a kind.
fn of_runs(
    runs: &[Vec<Visit>],
    is: impl Fn(&Visit) -> bool,
    of: impl Fn(&Visit) -> f64,
) -> Vec<f64> {
    let mean = |run: &Vec<Visit>| {
        let values: Vec<f64> = run.iter().filter(|it| is(it)).map(&of).collect();
        values.iter().sum::<f64>() / values.len().max(1) as f64
    };
    runs.iter().map(mean).collect()
}

fn mean(runs: &[Vec<Visit>], is: impl Fn(&Visit) -> bool, of: impl Fn(&Visit) -> f64) -> Mean {
    let means = of_runs(runs, is, of);
    let value = means.iter().sum::<f64>() / means.len().max(1) as f64;
    Mean { value, interval: (means.len() > 1).then(|| mean_interval(&means, CONFIDENCE)) }
}

fn reliability(runs: &[Vec<Visit>], is: impl Fn(&Visit) -> bool) -> Option<Interval> {
    let visits = runs.iter().flatten().filter(|it| is(it));
    let reached = visits.filter_map(|it| Some(*it.estimates.first()? <= it.reward()));
    let reached: Vec<bool> = reached.collect();
    (!reached.is_empty()).then(|| share(reached.iter().copied()).0)
}

/// A share with its exact interval, and of how many it is.
fn share(all: impl Iterator<Item = bool>) -> (Interval, u64) {
    let (hits, count) = all.fold((0, 0), |it, hit| (it.0 + u64::from(hit), it.1 + 1));
    (clopper_pearson(hits, count, CONFIDENCE), count)
}

fn in_condition(runs: &[Vec<Visit>], condition: Condition) -> InCondition {
    let is = |it: &Visit| it.condition == condition;
    let visits = || runs.iter().flatten().filter(|it| is(it));
    let ratio = |it: &Visit| it.rows.first().map(|it| it.ratio);
    let changes = |it: &Visit| Some((it.rows.get(1)?.way, ratio(it)?, it.switched()?));
    let (switched, second_trials) = share(
        visits()
            .filter_map(changes)
            .filter(|it| matches!(it.1, Ratio::R31 | Ratio::R51))
            .map(|it| it.2),
    );
    let to_fewer = share(visits().filter_map(changes).filter(|it| it.2).map(|(way, ratio, _)| {
        let [short, long] = ratio.discs();
        if way == Way::Short { short < long } else { long < short }
    }));
    let at = |of: Ratio| {
        let is = |it: &Visit| is(it) && ratio(it) == Some(of);
        let first = runs.iter().flatten().filter(|it| is(it)).filter_map(|it| it.rows.first());
        let short: Vec<bool> = first.map(|it| it.way == Way::Short).collect();
        AtRatio {
            ratio: of,
            errors: mean(runs, is, |it| it.errors() as f64),
            reward: mean(runs, is, Visit::reward),
            short_first: short.iter().filter(|it| **it).count() as u64,
            maps: short.len() as u64,
        }
    };
    InCondition {
        condition,
        errors: mean(runs, is, |it| it.errors() as f64),
        reward: mean(runs, is, Visit::reward),
        reward_with_stops: mean(runs, is, Visit::reward_with_stops),
        reliability: reliability(runs, is),
        relative_error: relative_error(visits()),
        switched,
        second_trials,
        to_fewer,
        ratios: Ratio::ALL.map(at).to_vec(),
    }
}

/// The mean square of estimate less reward over the variance of the reward.
fn relative_error<'v>(visits: impl Iterator<Item = &'v Visit>) -> Option<f64> {
    let both = visits.filter_map(|it| Some((*it.estimates.first()?, it.reward())));
    let both: Vec<(f64, f64)> = both.collect();
    let count = both.len() as f64;
    let mean = both.iter().map(|it| it.1).sum::<f64>() / count;
    let square = |it: f64| it * it;
    let variance = both.iter().map(|it| square(it.1 - mean)).sum::<f64>();
    let error = both.iter().map(|it| square(it.0 - it.1)).sum::<f64>();
    (variance > 0.0).then(|| error / variance)
}
