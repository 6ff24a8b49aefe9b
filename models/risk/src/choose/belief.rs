//! Belief after failed trials.

use super::model::Model;
use super::updated;

/// A rule by which failed trials change a belief.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Memory {
    /// As printed (eq. 4.30): the mean of what each failed trial alone tells.
    Sum,
    /// Bayes: the trials are independent given the hidden state, so their likelihoods are
    /// multiplied.
    Product,
}

/// A failed trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// The way that was taken.
    pub way: usize,
    /// Observation: a number of [`Model::observations`].
    pub observation: usize,
}

impl Model {
    /// The belief after failed trials.
    ///
    /// # Panics
    /// When a trial has a number that the model has not.
    pub fn belief(&self, prior: &[f64], trials: &[Seen], memory: Memory) -> Vec<f64> {
        let after = |belief: &[f64], trial: &Seen| {
            let likelihood = |hidden: usize| {
                let failure = 1.0 - self.success(hidden, trial.way);
                failure * self.seen(hidden, trial.way)[trial.observation]
            };
            updated(belief, likelihood)
        };
        match memory {
            Memory::Product => {
                trials.iter().fold(prior.to_vec(), |belief, trial| after(&belief, trial))
            }
            Memory::Sum if trials.is_empty() => prior.to_vec(),
            Memory::Sum => {
                let all: Vec<_> = trials.iter().map(|it| after(prior, it)).collect();
                let sum = |hidden: usize| all.iter().map(|it| it[hidden]).sum::<f64>();
                (0..prior.len()).map(|it| sum(it) / all.len() as f64).collect()
            }
        }
    }
}
