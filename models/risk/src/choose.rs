//! Choices with a known risk: which way a robot takes when a trial may fail, what it believes after
//! failures, and what a policy earns (Rohrmueller 2011, section 4.5).

mod belief;
mod model;
mod policy;
mod total;

pub use belief::{Memory, Seen};
pub use model::{Model, Names};
pub use policy::{Knows, expected_reward, optimal_reward};

use crate::quantile::{Convention, quantile};

/// A measure of a cost that is not certain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// The mean, with the middles of intervals (eq. 4.31).
    Mean,
    /// The upper bound of the first interval with which the cumulative probability reaches a level:
    /// eq. 4.32 as its discussion uses it; as printed, it takes the least partial sum.
    Quantile(f64),
}

/// A rule by which the trials to come are weighed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// As printed (eqs. 4.26 to 4.29): costs of a success and of a failure are weighted by the
    /// belief before the trial, which the trials after it share.
    Thesis,
    /// The same with what the trial tells: costs of a success by the belief given success, costs
    /// of a failure and later trials by the belief given failure. With the mean this is the
    /// expected cost.
    Exact,
    /// The measure of the total cost of a sequence of ways, each taken after a failure of those
    /// before it: a quantile of the whole, not a sum of quantiles. Proposition 4.3 is about that.
    Total,
}

/// The cost of beginning with each way, the best trials after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// For each way the cost, in units of the utility.
    pub costs: Vec<f64>,
    /// The way of the least cost, the first of equal ones; by [`Rule::Total`] of equal quantiles
    /// the one of the least mean.
    pub way: usize,
    /// The utility less that cost.
    pub reward: f64,
    /// By [`Rule::Total`] the ways of all trials.
    pub sequence: Vec<usize>,
}

/// Costs as near as this are equal.
const EQUAL: f64 = 1e-9;

/// The place of the least cost, the first of those that are equal.
pub(crate) fn least(costs: &[f64]) -> usize {
    let mut best = 0;
    for (at, cost) in costs.iter().enumerate() {
        if *cost < costs[best] - EQUAL {
            best = at;
        }
    }
    best
}

impl Model {
    /// Estimates each way under a belief, with so many trials left, by a measure and a rule.
    ///
    /// # Panics
    /// When the belief has another length than there are hidden states.
    pub fn estimate(
        &self,
        belief: &[f64],
        trials: usize,
        measure: Measure,
        rule: Rule,
    ) -> Estimate {
        assert_eq!(belief.len(), self.hidden(), "a belief for each hidden state");
        let (costs, sequence) = match rule {
            Rule::Total => self.total(belief, trials, measure),
            Rule::Thesis | Rule::Exact => (self.recursion(belief, trials, measure, rule), vec![]),
        };
        let way = sequence.first().copied().unwrap_or_else(|| least(&costs));
        let reward = self.utility() - costs.get(way).copied().unwrap_or(0.0);
        Estimate { costs, way, reward, sequence }
    }

    fn recursion(&self, belief: &[f64], trials: usize, measure: Measure, rule: Rule) -> Vec<f64> {
        let Some(later) = trials.checked_sub(1) else {
            return vec![self.utility(); self.ways()];
        };
        let rest = |belief: &[f64]| {
            let costs = self.recursion(belief, later, measure, rule);
            costs.get(least(&costs)).copied().unwrap_or(0.0)
        };
        let shared = (rule == Rule::Thesis).then(|| rest(belief));
        let way = |way: usize| {
            let success = weighted(belief, |it| self.success(it, way));
            let cost = |belief: &[f64], is_success: bool| {
                weighted(belief, |it| self.measured(it, way, is_success, measure))
            };
            let (after_success, after_failure);
            let (won, lost) = if rule == Rule::Thesis {
                (belief, belief)
            } else {
                after_success = updated(belief, |it| self.success(it, way));
                after_failure = updated(belief, |it| 1.0 - self.success(it, way));
                (after_success.as_slice(), after_failure.as_slice())
            };
            let mut sum = 0.0;
            if success > 0.0 {
                sum += success * cost(won, true);
            }
            if success < 1.0 {
                let rest = shared.unwrap_or_else(|| rest(lost));
                sum += (1.0 - success) * (cost(lost, false) + rest);
            }
            sum
        };
        (0..self.ways()).map(way).collect()
    }

    /// The measure of the cost of one trial, its end known.
    fn measured(&self, hidden: usize, way: usize, is_success: bool, measure: Measure) -> f64 {
        let costs = self.costs(hidden, way, is_success).iter().zip(self.bounds());
        match measure {
            Measure::Mean => costs.map(|(p, (low, high))| p * (low + high) / 2.0).sum(),
            Measure::Quantile(level) => {
                let values: Vec<_> = costs.map(|(p, (_, high))| (*high, *p)).collect();
                quantile(&values, level, Convention::Reached).unwrap_or(0.0)
            }
        }
    }
}

/// A sum weighted by a belief.
fn weighted(belief: &[f64], of: impl Fn(usize) -> f64) -> f64 {
    belief.iter().enumerate().filter(|it| *it.1 > 0.0).map(|(at, it)| it * of(at)).sum()
}

/// A belief times a likelihood, with a sum of 1; the belief itself where that is impossible.
fn updated(belief: &[f64], likelihood: impl Fn(usize) -> f64) -> Vec<f64> {
    let product: Vec<f64> = belief.iter().enumerate().map(|(at, it)| it * likelihood(at)).collect();
    let sum: f64 = product.iter().sum();
    if sum > 0.0 { product.iter().map(|it| it / sum).collect() } else { belief.to_vec() }
}
