//! True rewards of policies, by every course of events.

use super::belief::{Memory, Seen};
use super::least;
use super::model::Model;

/// Knowledge of the hidden state when a policy begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knows {
    /// The prior alone: `limited` in the thesis.
    Prior,
    /// The hidden state: `overview` in the thesis.
    Hidden,
}

/// The expected reward of a policy, the hidden state drawn from the prior, costs as the middles of
/// their intervals. The policy is given its first belief and the failed trials so far, and returns
/// for each way the chance to take it.
///
/// ```no_run
/// # use cotama_risk::{ChoiceRule, Knows, Measure, Memory, Model, Seen, expected_reward};
/// # fn of(model: &Model) -> f64 {
/// let policy = |prior: &[f64], failed: &[Seen]| {
///     let belief = model.belief(prior, failed, Memory::Product);
///     let left = model.trials() - failed.len();
///     let best = model.estimate(&belief, left, Measure::Mean, ChoiceRule::Thesis).way;
///     (0..model.ways()).map(|it| if it == best { 1.0 } else { 0.0 }).collect()
/// };
/// expected_reward(model, Knows::Prior, policy)
/// # }
/// ```
pub fn expected_reward(
    model: &Model,
    knows: Knows,
    mut policy: impl FnMut(&[f64], &[Seen]) -> Vec<f64>,
) -> f64 {
    let mut sum = 0.0;
    for (hidden, weight) in model.prior().iter().enumerate().filter(|it| *it.1 > 0.0) {
        let prior = match knows {
            Knows::Prior => model.prior().to_vec(),
            Knows::Hidden => known(model, hidden),
        };
        sum += weight * (model.utility() - spent(model, hidden, &prior, &mut vec![], &mut policy));
    }
    sum
}

fn known(model: &Model, hidden: usize) -> Vec<f64> {
    (0..model.hidden()).map(|it| f64::from(u8::from(it == hidden))).collect()
}

/// The expected cost from here on, the hidden state known to us.
fn spent(
    model: &Model,
    hidden: usize,
    prior: &[f64],
    failed: &mut Vec<Seen>,
    policy: &mut impl FnMut(&[f64], &[Seen]) -> Vec<f64>,
) -> f64 {
    if failed.len() == model.trials() {
        return model.utility();
    }
    let chances = policy(prior, failed);
    let mut sum = 0.0;
    for (way, chance) in chances.into_iter().enumerate().filter(|it| it.1 > 0.0) {
        let success = model.success(hidden, way);
        sum += chance * success * middle(model, hidden, way, true);
        if success >= 1.0 {
            continue;
        }
        let mut lost = middle(model, hidden, way, false);
        for observation in 0..model.observations().len() {
            let seen = model.seen(hidden, way)[observation];
            if seen > 0.0 {
                failed.push(Seen { way, observation });
                lost += seen * spent(model, hidden, prior, failed, policy);
                failed.pop();
            }
        }
        sum += chance * (1.0 - success) * lost;
    }
    sum
}

/// The mean cost of a trial, with middles of intervals.
fn middle(model: &Model, hidden: usize, way: usize, is_success: bool) -> f64 {
    let costs = model.costs(hidden, way, is_success).iter().zip(model.bounds());
    costs.map(|(p, (low, high))| p * (low + high) / 2.0).sum()
}

/// The expected reward of the best of all policies: expectimax over ways, ends and observations,
/// with the belief of Bayes.
pub fn optimal_reward(model: &Model, knows: Knows) -> f64 {
    let of = |belief: &[f64]| model.utility() - optimal(model, belief, model.trials());
    match knows {
        Knows::Prior => of(model.prior()),
        Knows::Hidden => {
            let prior = model.prior().iter().enumerate();
            prior.map(|(hidden, weight)| weight * of(&known(model, hidden))).sum()
        }
    }
}

fn optimal(model: &Model, belief: &[f64], trials: usize) -> f64 {
    let Some(later) = trials.checked_sub(1) else { return model.utility() };
    let cost = |way: usize| {
        let mut sum = 0.0;
        for (hidden, weight) in belief.iter().enumerate().filter(|it| *it.1 > 0.0) {
            let success = model.success(hidden, way);
            sum += weight * success * middle(model, hidden, way, true);
            sum += weight * (1.0 - success) * middle(model, hidden, way, false);
        }
        for observation in 0..model.observations().len() {
            let chance = |(hidden, weight): (usize, &f64)| {
                weight * (1.0 - model.success(hidden, way)) * model.seen(hidden, way)[observation]
            };
            let chance: f64 = belief.iter().enumerate().map(chance).sum();
            if chance > 0.0 {
                let seen = [Seen { way, observation }];
                let after = model.belief(belief, &seen, Memory::Product);
                sum += chance * optimal(model, &after, later);
            }
        }
        sum
    };
    let costs: Vec<f64> = (0..model.ways()).map(cost).collect();
    costs.get(least(&costs)).copied().unwrap_or(0.0)
}
